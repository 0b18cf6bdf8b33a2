// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html/page_style.hpp"

namespace adit {

const char* page_style() {
  return R"(
:root{color-scheme:light dark;--page:#fbfaf7;--text:#1d2024;--soft:#5d646c;--line:#d9d5cc;--box:#fff;
--link:#1d55a0;--warn:#a8231c;--way:#0d8a4e;--goal:#0b5fff;--p-wait:#9aa1a8;--p-explore:#8a4bc0;
--p-scan:#1a8f86;--p-plan:#c07f00;--p-execute:#2f6fc1;--p-paused:#c2372a;--p-stopped:#a8231c;
--b0:#ff00b8;--b1:#e0182d;--b2:#7b1fa2;--b3:#d9ab00;--b4:#1560bd;--b5:#7a4a21;--b6:#008b8b}
@media(prefers-color-scheme:dark){:root{--page:#15181c;--text:#e4e2dc;--soft:#a1a8b0;--line:#343a41;
--box:#1d2126;--link:#8ab8f5;--warn:#ff8a80;--p-wait:#6d757d;--p-explore:#b58ae0;--p-scan:#3fbdb3;
--p-plan:#e0a93a;--p-execute:#6aa3ec;--p-paused:#f0776b;--p-stopped:#ff8a80;
--sheet:#31373e;--ink:#e4e2dc;--rim:#15181c;--out:#6aa8f5;--back:#ff7b6b;--graph:#8d959d;--closure:#63c95e;
--revoked:#ffa24d;--corridor:#5b8ec9;--open:#ff5c77;--closed:#b3a1e0;--done:#59c48c;--scan:#e4e2dc;
--scan-ink:#15181c;--stuck:#ff8a80}.mine .ground{filter:invert(.88)}}
*{box-sizing:border-box}html{scroll-behavior:smooth;-webkit-text-size-adjust:100%}
body{margin:0;background:var(--page);color:var(--text);
font:17px/1.55 Charter,"Bitstream Charter","Sitka Text",Cambria,Georgia,serif}
main,header,nav,footer{max-width:74rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:2.2rem}h1,h2,h3,nav,table,dl,summary,figcaption,.timeline,.keys,.layers,.up,.tag
{font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
h1{font-size:1.05rem;font-weight:600;margin:0;color:var(--soft)}
h2{font-size:1.3rem;line-height:1.25;margin:2.8rem 0 .8rem;padding-top:.9rem;border-top:1px solid var(--line)}
h3{font-size:1rem;margin:0}p{max-width:44rem;margin:.6rem 0}
.outcome{font-size:1.65rem;line-height:1.3;margin:.5rem 0;max-width:52rem;text-wrap:pretty}
.why{color:var(--soft);font-size:1.05rem}.tag{display:inline-block;font-size:.72rem;font-weight:600;
border:1px solid currentColor;border-radius:.2rem;padding:.05rem .4rem;margin-left:.5rem;vertical-align:.08em}
.note{border-left:3px solid var(--p-plan);padding-left:.8rem;color:var(--soft)}
nav{margin-top:1.2rem}nav a{display:inline-block;margin:0 1.1rem .3rem 0;font-size:.9rem}
a{color:var(--link)}a:focus-visible,summary:focus-visible,.scroll:focus-visible,input:focus-visible
{outline:2px solid var(--link);outline-offset:2px;border-radius:2px}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(9.5rem,1fr));gap:.9rem 1.2rem;margin:1.2rem 0}
.figures dt{font-size:.76rem;color:var(--soft);line-height:1.3}
.figures dd{margin:.1rem 0 0;font-size:1.15rem;font-variant-numeric:tabular-nums;overflow-wrap:anywhere}
details{margin:.8rem 0}summary{cursor:pointer;font-size:.9rem;color:var(--link)}
.scroll{overflow-x:auto}table{border-collapse:collapse;width:100%;font-size:.84rem;line-height:1.4;
font-variant-numeric:tabular-nums;margin:.6rem 0}caption{text-align:left;color:var(--soft);padding-bottom:.3rem}
th,td{text-align:left;vertical-align:top;padding:.3rem .8rem .3rem 0;border-bottom:1px solid var(--line)}
th{font-weight:600;white-space:nowrap}td:not(:last-child){white-space:nowrap}td:last-child{min-width:14rem}
tr.open td:nth-child(2),tr.revoked td:nth-child(2){color:var(--warn);font-weight:600}
tr:target{background:color-mix(in srgb,var(--link) 14%,transparent)}
pre{font:.78rem/1.45 ui-monospace,"DejaVu Sans Mono",monospace;overflow-x:auto;background:var(--box);
border:1px solid var(--line);padding:.7rem}
.map{overflow:auto;background:var(--sheet);border:1px solid var(--line)}
.map svg{display:block;width:100%;height:auto;min-width:44rem;margin:0 auto}
.layers{border:0;padding:0;margin:.5rem 0;font-size:.85rem}.layers label{margin-right:1.1rem;white-space:nowrap}
.mine a:focus-visible circle,.mine a:hover circle{stroke:var(--link);stroke-width:3}
)"
         R"(.timeline{font-size:.8rem;margin:1rem 0}.lane{display:grid;grid-template-columns:4.6rem 1fr 9.5rem;
gap:.7rem;align-items:center;margin:.14rem 0}.lane svg{width:100%;height:1.15rem;background:var(--box);
border-bottom:1px solid var(--line)}.lane span:last-child{color:var(--soft);font-variant-numeric:tabular-nums}
.lane.wait rect{fill:var(--p-wait)}.lane.explore rect{fill:var(--p-explore)}.lane.scan rect{fill:var(--p-scan)}
.lane.plan rect{fill:var(--p-plan)}.lane.execute rect{fill:var(--p-execute)}
.lane.paused rect{fill:var(--p-paused)}.lane.stopped rect{fill:var(--p-stopped)}
.turn{stroke:var(--back);stroke-width:2;vector-effect:non-scaling-stroke;fill:none}
.axis div{display:flex;justify-content:space-between;color:var(--soft)}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,34rem),1fr));gap:1.2rem}
.card{background:var(--box);border:1px solid var(--line);border-radius:.3rem;padding:.9rem 1rem;
scroll-margin-top:1rem;min-width:0}.card.stuck{border-left:4px solid var(--warn)}
.card:target{outline:2px solid var(--link)}.verdict{margin:.2rem 0 .7rem;line-height:1.4}
.pictures{display:grid;grid-template-columns:1fr 1fr;gap:.7rem;align-items:end}
.pictures figure{margin:0;min-width:0}.pictures figure:last-child:nth-child(odd){grid-column:1/-1}
.pictures svg,.pictures img{display:block;width:100%;height:auto;max-height:22rem;background:#14171c}
.pictures img{object-fit:cover;max-height:13rem}figcaption{font-size:.72rem;color:var(--soft);margin-top:.2rem}
.card .figures{grid-template-columns:repeat(auto-fill,minmax(7rem,1fr));gap:.4rem 1rem;margin:.7rem 0 0}
.card .figures dd{font-size:.86rem}.up{font-size:.78rem;margin:.5rem 0 0}
.cells{fill:none}.cells image{image-rendering:pixelated}
.cells .way{stroke:var(--way);stroke-width:1.6}.cells .step{stroke:var(--way);stroke-width:.5;opacity:.8}
.cells .robot{stroke:#0d8a4e;stroke-width:1;fill:#ffffff66}.cells .ahead{fill:#0d8a4e}
.cells .goal{stroke:var(--goal);stroke-width:.9;stroke-dasharray:2 2}.cells circle.goal{stroke-dasharray:none}
.b0,.b1,.b2,.b3,.b4,.b5,.b6{stroke-width:1.15;fill:none}.b0{stroke:var(--b0)}.b1{stroke:var(--b1)}.b2{stroke:var(--b2)}
.b3{stroke:var(--b3)}.b4{stroke:var(--b4)}.b5{stroke:var(--b5)}.b6{stroke:var(--b6)}
.keys{list-style:none;padding:0;display:grid;grid-template-columns:repeat(auto-fill,minmax(13rem,1fr));
gap:.25rem 1rem;font-size:.8rem}.keys i{display:inline-block;width:1.5rem;height:.75rem;margin-right:.5rem;
border:1px solid var(--line);vertical-align:-.05em}
.layers:has(#show-path:not(:checked)) .layer-path,
.layers:has(#show-scans:not(:checked)) .layer-scans,
.layers:has(#show-frontiers:not(:checked)) .layer-frontiers,
.layers:has(#show-corridors:not(:checked)) .layer-corridors,
.layers:has(#show-graph:not(:checked)) .layer-graph,
.layers:has(#show-revoked:not(:checked)) .layer-revoked{display:none}
footer{margin:3rem auto 2rem;color:var(--soft);font-size:.82rem}
@media(max-width:40rem){body{font-size:16px}.outcome{font-size:1.3rem}.figures{grid-template-columns:1fr 1fr}
.lane{grid-template-columns:3.8rem 1fr}.lane span:last-child{grid-column:2;margin-top:-.2rem}
.axis>span:last-child{display:none}.axis div span:nth-child(even){display:none}}
@media print{:root{--page:#fff;--box:#fff}body{font-size:10.5pt}nav,.up,label,input{display:none}
.map{border:0;overflow:visible}.map svg{min-width:0}.card,tr,figure{break-inside:avoid}.cards{display:block}
.card{margin-bottom:1rem}h2{break-after:avoid}.pictures svg,.pictures img{max-height:14rem}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";
}

const char* page_script() {
  return R"(addEventListener('beforeprint',()=>{for(const d of document.querySelectorAll('details'))d.open=true});
function reveal(){const e=location.hash&&document.getElementById(location.hash.slice(1));
for(let d=e&&e.closest('details');d;d=d.parentElement.closest('details'))d.open=true}
addEventListener('hashchange',reveal);reveal();)";
}

}  // namespace adit
