// A model from a .glb: its meshes, each with its node's number in the file. SPDX-License-Identifier: MIT
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { ridged } from "./ridges.js";

// Without reflections: metals would be black, and each of their shaders takes a software renderer 0.1 s.
function matt({ color, map, vertexColors, flatShading, side, transparent, opacity, alphaTest }) {
  return ridged(new THREE.MeshLambertMaterial({ color, map, vertexColors, flatShading, side, transparent, opacity, alphaTest }));
}

// The node of a mesh or, if it is one of several of its node, of their group.
function nodeOf(part, associations) {
  const own = associations.get(part)?.nodes;
  return own ?? (part.parent ? nodeOf(part.parent, associations) : undefined);
}

// Reads the model in a .glb and loads no other files: an untrusted file may name images on any host. paintsRidges: its
// textures show ridges, which would differ from those that are set.
export async function read(bytes, paintsRidges) {
  const manager = new THREE.LoadingManager().setURLModifier((url) => (/^(data|blob):/.test(url) ? url : "data:,"));
  const { scene, parser } = await new GLTFLoader(manager).parseAsync(bytes, "");
  scene.traverse((part) => {
    if (part.isMesh) {
      if (paintsRidges && part.material.map) {
        part.material.map.dispose();
        part.material.map = null;
      }
      part.material = matt(part.material);
      const node = nodeOf(part, parser.associations);
      const { name, mesh } = parser.json.nodes[node] ?? {};
      part.userData = { node, surface: -1, name: name || parser.json.meshes?.[mesh]?.name || `node ${node}` };
    }
  });
  return scene;
}

export function dispose(model) {
  model.traverse((part) => {
    if (part.isMesh) {
      part.geometry.dispose();
      part.material.map?.dispose();
      part.material.map?.source.data?.close?.(); // an ImageBitmap
      part.material.dispose();
    }
  });
}
