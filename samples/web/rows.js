// A tick as a row of numbers, sent by web.c and `knurl run --view`. SPDX-License-Identifier: MIT
export const ROW = 23;
export const METHODS = 3; // S1, S2, bandlimited: numbers 1 to 3
export const AT = { force: 0, hip: 3, proxy: 6, depth: 9, height: 10, frequency: 11, cycles: 12, contact: 14, surface: 15,
  time: 16, velocity: 17, spatial: 19, normal: 20 };

export const vector = (row, at) => row.subarray(at, at + 3);
export const length = (v) => Math.hypot(v[0], v[1], v[2]);

// --- CSV: the columns of `knurl run --out`, and further ones for drawing ---

const COLUMNS = [["t", 16], ["x", 3], ["y", 4], ["z", 5], ["vx", 17], ["vy", 18], ["surface"], ["depth", 9], ["fs", 19],
  ["ft", 11], ["height", 10], ["fx", 0], ["fy", 1], ["fz", 2], ["px", 6], ["py", 7], ["pz", 8], ["nx", 20], ["ny", 21],
  ["nz", 22], ["cycles_x", 12], ["cycles_y", 13]];

// As in the tool: without its first apostrophe a cell is the name; `none` means no contact.
function cell(name) {
  const text = /^\s*['=+\-@＝＋－＠]|^none$/.test(name) ? `'${name}` : name;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function toCsv(rows, surfaces) {
  const lines = [COLUMNS.map(([name]) => name).join()];
  for (let k = 0; k < rows.length; k += ROW) {
    const name = surfaces[rows[k + AT.surface]]?.name;
    const found = name === undefined ? "none" : cell(name);
    lines.push(COLUMNS.map(([, at]) => (at === undefined ? found : rows[k + at])).join());
  }
  return `${lines.join("\n")}\n`;
}

function cells(line) {
  return [...line.matchAll(/(?:"((?:[^"]|"")*)"|([^,]*))(?:,|$)/g)].map(([, quoted, plain]) =>
    quoted === undefined ? plain : quoted.replaceAll('""', '"'));
}

// Rows from such a file. Without the columns beyond the tool's own, the surface is taken to lie along the force. Throws
// an error message.
export function fromCsv(text, surfaces) {
  const lines = text.trim().split(/\r?\n/);
  const header = cells(lines[0]);
  const needed = COLUMNS.slice(0, 14).filter(([name]) => !header.includes(name));
  if (needed.length > 0 || lines.length < 3) {
    throw new Error(needed.length > 0 ? `expected columns as knurl run --out writes them, found no ${needed[0][0]}`
      : "expected two rows or more");
  }
  const rows = new Float64Array(ROW * (lines.length - 1));
  const places = COLUMNS.filter(([name, at]) => at !== undefined && header.includes(name))
    .map(([name, at]) => [header.indexOf(name), at]);
  const named = header.indexOf("surface");
  for (let k = 1; k < lines.length; k++) {
    const row = rows.subarray(ROW * (k - 1), ROW * k);
    const found = cells(lines[k]);
    for (const [column, at] of places) {
      row[at] = Number(found[column] || NaN);
      if (!Number.isFinite(row[at])) {
        throw new Error(`line ${k + 1}: expected a number for ${header[column]}, found '${found[column] ?? "nothing"}'`);
      }
    }
    row[AT.contact] = found[named] === "none" ? 0 : 1;
    row[AT.surface] = row[AT.contact] ? Math.max(0, surfaces.findIndex(({ name }) => name === found[named].replace(/^'/, ""))) : -1;
    if (!header.includes("nz")) {
      const force = length(vector(row, AT.force));
      for (let i = 0; i < 3; i++) {
        row[AT.normal + i] = force > 0 ? row[AT.force + i] / force : 0;
        row[AT.proxy + i] = row[AT.hip + i] + row[AT.depth] * row[AT.normal + i];
      }
    }
  }
  return rows;
}
