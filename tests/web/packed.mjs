// Files that Draco or meshopt has compressed: unpacked in the page, tagged, saved, and read by the tool.
// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { drop, forgive, modules, open, tmp, tool } from "./harness.mjs";

const NAME = "the plate";

// A plate of 100 x 40 mm in 20 x 8 squares, facing up.
function plate() {
  const [across, along] = [20, 8];
  const positions = [];
  const indices = [];
  for (let j = 0; j <= along; j++) {
    for (let i = 0; i <= across; i++) {
      positions.push(0.1 * (i / across - 0.5), 0, 0.04 * (j / along - 0.5));
      const at = j * (across + 1) + i;
      if (i < across && j < along) {
        indices.push(at, at + across + 1, at + 1, at + 1, at + across + 1, at + across + 2);
      }
    }
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

function accessors({ positions, indices }) {
  return [{ componentType: 5126, count: positions.length / 3, type: "VEC3", min: [-0.05, 0, -0.02], max: [0.05, 0, 0.02] },
    { componentType: 5125, count: indices.length, type: "SCALAR" }];
}

function glb(json, binary) {
  const whole = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: NAME }], ...json };
  const text = Buffer.from(JSON.stringify(whole));
  const parts = [[0x4e4f534a, text, 0x20], [0x004e4942, Buffer.from(binary), 0]].map(([kind, bytes, fill]) => {
    const padded = Buffer.alloc(8 + 4 * Math.ceil(bytes.length / 4), fill);
    padded.writeUInt32LE(padded.length - 8, 0);
    padded.writeUInt32LE(kind, 4);
    bytes.copy(padded, 8);
    return padded;
  });
  const head = Buffer.alloc(12);
  head.writeUInt32LE(0x46546c67, 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + parts[0].length + parts[1].length, 8);
  return Buffer.concat([head, ...parts]);
}

async function byDraco() {
  const { createEncoderModule } = createRequire(join(modules, "x.js"))("draco3d");
  const draco = await createEncoderModule({});
  const { positions, indices } = plate();
  const [builder, mesh, encoder, bytes] = [new draco.MeshBuilder(), new draco.Mesh(), new draco.Encoder(), new draco.DracoInt8Array()];
  builder.AddFacesToMesh(mesh, indices.length / 3, indices);
  const id = builder.AddFloatAttributeToMesh(mesh, draco.POSITION, positions.length / 3, 3, positions);
  encoder.SetAttributeQuantization(draco.POSITION, 14);
  const size = encoder.EncodeMeshToDracoBuffer(mesh, bytes);
  const packed = Uint8Array.from({ length: size }, (_, i) => bytes.GetValue(i));
  const extension = { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: id } } };
  return glb({ extensionsUsed: Object.keys(extension), extensionsRequired: Object.keys(extension), accessors: accessors(plate()),
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, extensions: extension }] }],
    bufferViews: [{ buffer: 0, byteLength: size }], buffers: [{ byteLength: size }] }, packed);
}

async function byMeshopt() {
  const { MeshoptEncoder } = await import(pathToFileURL(join(modules, "meshoptimizer/index.js")));
  await MeshoptEncoder.ready;
  const { positions, indices } = plate();
  const streams = [[positions, 12, positions.length / 3, "ATTRIBUTES"], [indices, 4, indices.length, "TRIANGLES"]];
  const packed = streams.map(([values, stride, count, mode]) =>
    Buffer.from(MeshoptEncoder.encodeGltfBuffer(new Uint8Array(values.buffer), count, stride, mode)));
  let [from, at] = [0, 0];
  const bufferViews = streams.map(([values, byteStride, count, mode], i) => {
    const view = { buffer: 1, byteOffset: at, byteLength: values.byteLength, ...(i === 0 ? { byteStride } : {}),
      extensions: { EXT_meshopt_compression: { buffer: 0, byteOffset: from, byteLength: packed[i].length, byteStride, count, mode } } };
    from += packed[i].length;
    at += values.byteLength;
    return view;
  });
  const names = ["EXT_meshopt_compression"];
  return glb({ extensionsUsed: names, extensionsRequired: names, bufferViews,
    accessors: accessors(plate()).map((accessor, bufferView) => ({ ...accessor, bufferView })),
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    buffers: [{ byteLength: from }, { byteLength: at, extensions: { EXT_meshopt_compression: { fallback: true } } }] }, Buffer.concat(packed));
}

export const cases = {
  async "a file compressed by Draco or meshopt is unpacked, tagged, and read by the tool"() {
    for (const [kind, make] of Object.entries({ draco: byDraco, meshopt: byMeshopt })) {
      const tab = await open();
      await drop(tab, await make(), `${kind}.glb`);
      await tab.waitForFunction((name) => document.querySelector("#status").textContent.startsWith(`${name}.glb: nothing is tagged`), kind);
      await tab.selectOption("#part", { label: NAME });
      await tab.click("#give");
      await tab.waitForFunction(() => /1 surface to stroke/.test(document.querySelector("#status").textContent));
      await tab.waitForFunction(() => /force0\.[^0]/.test(document.querySelector("#numbers").textContent));
      const [download] = await Promise.all([tab.waitForEvent("download"), tab.click("#tag")]);
      const saved = join(tmp, `${kind}-tagged.glb`);
      await download.saveAs(saved);
      execFileSync(tool, ["inspect", saved, "--check"]);
      const { surfaces } = JSON.parse(execFileSync(tool, ["inspect", saved]));
      assert.deepEqual(surfaces.map(({ name }) => name), [NAME]);
      assert.deepEqual(surfaces[0].material.spatial_frequency, [1000, 0]);
    }
  },

  async "a compressed file that is damaged gets a sentence"() {
    const tab = await open();
    const bytes = await byDraco();
    bytes.fill(0xff, bytes.length - 200);
    await drop(tab, bytes, "damaged.glb");
    await tab.waitForFunction(() => /^damaged.glb: it cannot be/.test(document.querySelector("#status.error")?.textContent));
    forgive(/DRACOLoader/); // three.js' own
  },
};
