// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

/** The notices of the packages that the page contains, which their licences ask to keep with every copy. */
function notices(modules: Iterable<string>): string {
  const folders = new Set<string>();
  for (const module of modules) {
    const match = /^\0?(.*\/node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(module);
    if (match) folders.add(match[1]!);
  }
  const packagesOf = new Map<string, string[]>();  // by text of the licence
  for (const folder of [...folders].sort()) {
    const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, "utf8")) as Record<string, string>;
    const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
    const text = file ? readFileSync(`${folder}/${file}`, "utf8").trim() : "";
    packagesOf.set(text, [...(packagesOf.get(text) ?? []), `${name} ${version} (${license})`]);
  }
  return [...packagesOf].map(([text, packages]) => `${packages.join(", ")}\n\n${text}`).join("\n\n\n").replaceAll("--", "- -");
}

/** Puts all scripts and styles into the page, so that it is one file that loads nothing. */
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = bundle["page.html"];
      if (page?.type !== "asset") this.error("page.html was not built");
      let html = String(page.source);
      let styles = "";
      let script = "";
      for (const [name, output] of Object.entries(bundle)) {
        if (output.type === "chunk") script += output.code;
        else if (name.endsWith(".css")) styles += String(output.source);
        else if (name !== "page.html") this.error(`${name} would be a second file`);
        if (name !== "page.html") delete bundle[name];
      }
      // The writer of a finished mission inserts its data before the only </body>.
      script = script.replaceAll("</script", "<\\/script").replaceAll("</body", "<\\/body");
      html = html
        .replace(/\s*<script type="module"[^>]*src=[^>]*><\/script>/, "")
        .replace(/\s*<link rel="(stylesheet|modulepreload)"[^>]*>/g, "")
        .replace("<html", () => `<!-- This page contains:\n\n${notices(this.getModuleIds())}\n-->\n<html`)
        .replace("</head>", () => `<style>${styles}</style>\n</head>`)
        .replace("</body>", () => `<script type="module">${script}</script>\n</body>`);
      if (html.split("</body>").length !== 2) this.error("page.html needs exactly one </body>");
      page.source = html;
    },
  };
}

export default defineConfig({
  root: fileURLToPath(new URL(".", import.meta.url)),
  plugins: [oneFile()],
  build: {
    target: "es2021",
    modulePreload: false,
    cssCodeSplit: false,
    assetsInlineLimit: 1 << 20,
    chunkSizeWarningLimit: 1500,
    rollupOptions: {
      input: fileURLToPath(new URL("page.html", import.meta.url)),
      output: { inlineDynamicImports: true },
    },
  },
  test: { include: ["test/unit/**/*.test.ts"] },
} as Parameters<typeof defineConfig>[0]);
