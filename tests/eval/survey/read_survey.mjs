// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// read_survey.mjs DIR: reads cloud.las by the package copc and survey.dxf by the package dxf-parser, which share no code
// with this project, and prints what they find. Ends with 1 if a file is not what it should be.
import {readFile} from 'node:fs/promises';
import {join} from 'node:path';
import {Las} from 'copc';
import DxfParser from 'dxf-parser';

function check(holds, text) {
  if (holds) return;
  console.error(text);
  process.exit(1);
}

async function readLas(path) {
  const bytes = new Uint8Array(await readFile(path));
  const get = async (from, to) => bytes.subarray(from, to);
  const header = Las.Header.parse(bytes.subarray(0, 375));
  check(header.minorVersion === 4 && header.pointDataRecordFormat === 6, 'not LAS 1.4 with format 6');
  check(header.pointDataOffset + header.pointCount * header.pointDataRecordLength === bytes.length, 'length of the file');
  const records = await Las.Vlr.walk(get, header);
  const find = (id) => records.find((record) => record.recordId === id);
  const extra = Las.ExtraBytes.parse(await Las.Vlr.fetch(get, find(4)));
  const wkt = new TextDecoder().decode(await Las.Vlr.fetch(get, find(2112)));
  const data = bytes.subarray(header.pointDataOffset);
  const view = Las.View.create(data, header, extra);
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((x) => -x);
  ['X', 'Y', 'Z'].forEach((axis, i) => {
    const at = view.getter(axis);
    for (let k = 0; k < header.pointCount; ++k) {
      low[i] = Math.min(low[i], at(k));
      high[i] = Math.max(high[i], at(k));
    }
    check(Math.abs(low[i] - header.min[i]) < 1e-6 && Math.abs(high[i] - header.max[i]) < 1e-6, `extent along ${axis}`);
  });
  const last = (name) => view.getter(name)(header.pointCount - 1);
  console.log(`cloud.las: ${header.pointCount} points, ${low.map((x) => x.toFixed(2))} to ${high.map((x) => x.toFixed(2))}`);
  console.log(`  attributes ${extra.map((field) => field.name).join(', ')}; last point: scan ${last('scan')}, ` +
    `sd_plan ${last('sd_plan').toFixed(3)}, sd_z ${last('sd_z').toFixed(3)}`);
  console.log(`  ${wkt.slice(0, 60)}..`);
}

async function readDxf(path) {
  const drawing = new DxfParser().parseSync(await readFile(path, 'utf8'));
  const layers = new Map();
  for (const entity of drawing.entities) layers.set(entity.layer, (layers.get(entity.layer) ?? 0) + 1);
  check(layers.has('WALLS') && layers.has('CENTRE_LINES'), 'layers of the drawing');
  check(drawing.entities.some((entity) => entity.type === 'MTEXT'), 'texts of the drawing');
  console.log(`survey.dxf: ${[...layers].map(([name, n]) => `${name} ${n}`).join(', ')}`);
}

const folder = process.argv[2];
await readLas(join(folder, 'cloud.las'));
await readDxf(join(folder, 'survey.dxf'));
