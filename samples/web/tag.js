// Tags in a .glb: which nodes have a mesh, and a copy of the file in which one of them is tagged.
// SPDX-License-Identifier: MIT
const MAGIC = 0x46546c67; // "glTF"
const JSON_CHUNK = 0x4e4f534a;

// {json, rest: the bytes after the JSON chunk}, or null if it is not a .glb file.
function parse(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 20 || view.getUint32(0, true) !== MAGIC || view.getUint32(16, true) !== JSON_CHUNK) {
    return null;
  }
  const end = 20 + view.getUint32(12, true);
  try {
    return end <= buffer.byteLength &&
      { json: JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, end - 20))), rest: new Uint8Array(buffer, end) };
  } catch {
    return null;
  }
}

// [{name, index}] of the nodes with a mesh; nodes without a name get the mesh's, as in the library.
export function nodesWithMesh(buffer) {
  const { json } = parse(buffer) || { json: {} };
  const nodes = Array.isArray(json?.nodes) ? json.nodes : [];
  return nodes.map((node, index) => ({ name: node?.name || json.meshes?.[node?.mesh]?.name || `node ${index}`, index }))
    .filter(({ index }) => json.meshes?.[nodes[index]?.mesh]);
}

// A copy in which the tag replaces the node's previous one.
export function withTag(buffer, index, tag) {
  const { json, rest } = parse(buffer);
  const node = json.nodes[index];
  const others = Object.entries(node.extras ?? {}).filter(([key]) => !key.startsWith("knurl"));
  const axis = node.extras?.knurl?.axis ?? node.extras?.knurl_axis;
  node.extras = { ...Object.fromEntries(others), knurl: { ...tag, axis } };
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = Math.ceil(text.length / 4) * 4;
  const file = new Uint8Array(20 + padded + rest.length).fill(0x20);
  const view = new DataView(file.buffer);
  [MAGIC, 2, file.length, padded, JSON_CHUNK].forEach((value, i) => view.setUint32(4 * i, value, true));
  file.set(text, 20);
  file.set(rest, 20 + padded);
  return file.buffer;
}
