// Unpacks a .glb that is compressed by Draco or meshopt, which the library does not read: a plain .glb with the same
// nodes, materials and extras. Loaded only for such files. SPDX-License-Identifier: MIT
import * as THREE from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

// Numbers of any type as floats: the exporter would write quantised ones as they are.
function floats(attribute) {
  const { count, itemSize } = attribute;
  const values = new Float32Array(count * itemSize);
  for (let i = 0; i < values.length; i++) {
    values[i] = attribute.getComponent(Math.floor(i / itemSize), i % itemSize);
  }
  return new THREE.BufferAttribute(values, itemSize);
}

// three.js replaces spaces in names, and keeps the original.
function restore(part) {
  part.name = part.userData.name ?? part.name;
  delete part.userData.name;
  for (const [key, attribute] of Object.entries(part.geometry?.attributes ?? {})) {
    if (attribute.isInterleavedBufferAttribute || !(attribute.array instanceof Float32Array)) {
      part.geometry.setAttribute(key, floats(attribute));
    }
  }
}

export async function unpack(bytes) {
  const draco = new DRACOLoader().setDecoderPath(new URL("draco/", import.meta.url).href);
  const manager = new THREE.LoadingManager().setURLModifier((url) => (/^(data|blob):/.test(url) ? url : "data:,"));
  const loader = new GLTFLoader(manager).setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder);
  try {
    const { scene } = await loader.parseAsync(bytes, "");
    scene.traverse(restore);
    return await new GLTFExporter().parseAsync(scene.children, { binary: true, onlyVisible: false });
  } finally {
    draco.dispose();
  }
}
