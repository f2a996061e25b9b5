// Draws the ridges on any model: its material's shader evaluates Eq. 11 at the surface's coordinates, which the library
// gives for each triangle, and at the ridges per metre that are set. SPDX-License-Identifier: MIT
import * as THREE from "three";

const MOST_TRIANGLES = 40000; // of a model; more would take seconds
const CHUNK = 1000; // triangles that are surveyed at once: ticks go on between
const INSET = 0.05; // a corner is surveyed this far from it, in the triangle

// A square wave, whose edges are as sharp as a pixel allows; it fades if ridges are finer than pixels.
const WAVE = `
varying vec3 vCoordinates;
uniform vec2 ridges;
float wave(float cycles) {
  float wide = fwidth(cycles);
  float edge = clamp(cos(6.2831853 * cycles) / (3.1 * wide + 0.15), -1.0, 1.0);
  return mix(edge, 0.0, smoothstep(0.3, 0.7, wide));
}
float height() {
  vec2 cycles = vCoordinates.xy * ridges;
  return (ridges.x > 0.0 ? wave(cycles.x) : 1.0) * (ridges.y > 0.0 ? wave(cycles.y) : 1.0) *
    float(ridges.x + ridges.y > 0.0);
}`;

// material.userData.ridges: fsx, fsy.
export function ridged(material) {
  material.userData.ridges = { value: new THREE.Vector2(0, 0) };
  material.onBeforeCompile = (shader) => {
    shader.uniforms.ridges = material.userData.ridges;
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nattribute vec3 coordinates; varying vec3 vCoordinates;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvCoordinates = coordinates;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n${WAVE}`)
      .replace("#include <color_fragment>",
        "#include <color_fragment>\ndiffuseColor.rgb *= 1.0 - 0.24 * vCoordinates.z * (1.0 - height());");
  };
  material.customProgramCacheKey = () => "ridged";
  return material;
}

// The corners of a geometry's triangles in the scene, moved into them, with the triangles' normals: six numbers each.
function corners(mesh, geometry) {
  const at = geometry.getAttribute("position");
  const points = new Float64Array(6 * at.count);
  const [a, b, c, middle] = Array.from({ length: 4 }, () => new THREE.Vector3());
  for (let i = 0; i < at.count; i += 3) {
    [a, b, c].forEach((corner, k) => corner.fromBufferAttribute(at, i + k).applyMatrix4(mesh.matrixWorld));
    middle.copy(a).add(b).add(c).divideScalar(3);
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    [a, b, c].forEach((corner, k) => points.set([...corner.lerp(middle, INSET), ...normal], 6 * (i + k)));
  }
  return points;
}

// From coordinates at the inset corners to those at the corners: they are linear in a triangle. Returns how many
// corners are on each surface.
function spread(found, coordinates, from) {
  const hits = new Map();
  for (let i = 0; i < found.length; i += 9) {
    const on = found[i + 2] >= 0 && found[i + 2] === found[i + 5] && found[i + 2] === found[i + 8];
    for (let k = 0; on && k < 9; k += 3) {
      for (let axis = 0; axis < 2; axis++) {
        const mean = (found[i + axis] + found[i + 3 + axis] + found[i + 6 + axis]) / 3;
        coordinates[from + i + k + axis] = mean + (found[i + k + axis] - mean) / (1 - INSET);
      }
      coordinates[from + i + k + 2] = 1;
      hits.set(found[i + 2], (hits.get(found[i + 2]) ?? 0) + 3);
    }
  }
  return hits;
}

// Gives each mesh of a model its surface and coordinates. ask(points, depth): answers u, v and surface of each point;
// stillShown(): false ends it.
export async function survey(model, size, ask, stillShown) {
  const meshes = [];
  let triangles = 0;
  model.traverse((part) => {
    if (part.isMesh) {
      const { index, attributes } = part.geometry;
      triangles += (index ?? attributes.position).count / 3;
      meshes.push(part);
    }
  });
  for (const mesh of triangles <= MOST_TRIANGLES ? meshes : []) {
    const geometry = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry;
    const points = corners(mesh, geometry);
    const coordinates = new Float32Array(points.length / 2);
    let most = 0;
    for (let at = 0; at < points.length; at += 18 * CHUNK) {
      const found = await ask(points.subarray(at, at + 18 * CHUNK), 2e-3 * size);
      if (!stillShown()) {
        return;
      }
      for (const [surface, count] of spread(found, coordinates, at / 2)) {
        [mesh.userData.surface, most] = count > most ? [surface, count] : [mesh.userData.surface, most];
      }
    }
    if (most > 0) {
      geometry.setAttribute("coordinates", new THREE.BufferAttribute(coordinates, 3));
      if (geometry !== mesh.geometry) {
        mesh.geometry.dispose();
        mesh.geometry = geometry;
      }
    }
  }
}
