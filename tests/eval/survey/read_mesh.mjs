// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// read_mesh.mjs FILE.ply: reads the mesh of the void by the package three, and looks with three-mesh-bvh for triangles that
// cross each other; neither shares code with CGAL, which made the mesh, nor with this project. Prints borders, edges of more
// than two triangles and crossing triangles; ends with 1 if there are edges or triangles of these kinds.
import {readFile} from 'node:fs/promises';
import {Matrix4, Vector3} from 'three';
import {PLYLoader} from 'three/addons/loaders/PLYLoader.js';
import {ExtendedTriangle, MeshBVH} from 'three-mesh-bvh';

// Triangles that share a vertex touch there: each is made smaller by this share about its middle.
const kShrink = 1e-3;

/// Edges by the number of triangles that have them, and the closed lines of those with one.
function edgesOf(index, vertices) {
  const uses = new Map();
  for (let t = 0; t < index.length; t += 3) {
    for (let i = 0; i < 3; ++i) {
      const a = index[t + i];
      const b = index[t + (i + 1) % 3];
      const key = Math.min(a, b) * vertices + Math.max(a, b);
      uses.set(key, (uses.get(key) ?? 0) + 1);
    }
  }
  const border = new Map();
  const find = (v) => {
    let root = v;
    while (border.get(root) !== root) root = border.get(root);
    border.set(v, root);
    return root;
  };
  let several = 0;
  for (const [key, count] of uses) {
    if (count > 2) ++several;
    if (count !== 1) continue;
    const ends = [Math.floor(key / vertices), key % vertices];
    for (const v of ends) if (!border.has(v)) border.set(v, v);
    border.set(find(ends[0]), find(ends[1]));
  }
  let borders = 0;
  for (const [v, parent] of border) if (v === parent) ++borders;
  return {borders, several};
}

function crossings(geometry) {
  const tree = new MeshBVH(geometry);  // reorders the triangles of the geometry
  const index = geometry.index.array;
  const corner = (t, i) => index[3 * t + i];
  const shrunk = (triangle) => {
    const small = new ExtendedTriangle(triangle.a.clone(), triangle.b.clone(), triangle.c.clone());
    const middle = triangle.a.clone().add(triangle.b).add(triangle.c).divideScalar(3);
    for (const p of [small.a, small.b, small.c]) p.lerp(middle, kShrink);
    small.needsUpdate = true;
    return small;
  };
  let count = 0;
  tree.bvhcast(tree, new Matrix4(), {
    intersectsTriangles: (a, b, i, k) => {
      if (i >= k) return false;
      let shared = 0;
      for (let m = 0; m < 3; ++m) {
        for (let n = 0; n < 3; ++n) shared += corner(i, m) === corner(k, n) ? 1 : 0;
      }
      if (shared < 2 && shrunk(a).intersectsTriangle(shrunk(b))) ++count;
      return false;
    },
  });
  return count;
}

const bytes = await readFile(process.argv[2]);
const geometry = new PLYLoader().parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
const position = geometry.getAttribute('position');
const {borders, several} = edgesOf(geometry.index.array, position.count);
const size = geometry.computeBoundingBox() ?? geometry.boundingBox.getSize(new Vector3());
const crossing = crossings(geometry);
console.log(`void.ply: ${position.count} vertices, ${geometry.index.count / 3} triangles, ${size.x.toFixed(1)} by ` +
  `${size.y.toFixed(1)} by ${size.z.toFixed(1)} m; ${borders} borders, ${several} edges of more than two triangles, ` +
  `${crossing} pairs of triangles that cross`);
process.exit(several + crossing > 0 ? 1 : 0);
