// Presses a smooth plate 1 mm deep, which answers with K times the depth: 0.4 N. usage: node plate.mjs API.json LIBKNURL.so
// SPDX-License-Identifier: MIT
import { load } from "./knurl.mjs";

const knurl = load(process.argv[2], process.argv[3]);
const { koffi, create, set, get, check } = knurl;
const plane = create("knurl_plane_desc");
const material = set("knurl_material_desc", create("knurl_material_desc"), { stiffness: 400 }); // N/m
const surface = set("knurl_surface_desc", create("knurl_surface_desc"), { plane, material });

const pointer = koffi.alloc("void *", 1);
check(knurl.knurl_scene_create(null, pointer));
const scene = koffi.decode(pointer, "void *");
check(knurl.knurl_scene_add_surface(scene, surface, null));
check(knurl.knurl_scene_commit(scene));

const input = create("knurl_tick_input");
const output = create("knurl_tick_output");
for (let tick = 0; tick < 1000; tick++) {
  set("knurl_tick_input", input, { position: [0, 0, Math.max(-0.001, 0.001 - 0.00001 * tick)] }); // m
  check(knurl.knurl_scene_tick(scene, 0, input, output));
}
console.log(`${get("knurl_tick_output", output).force[2].toFixed(6)} N, knurl ${knurl.knurl_version_string()}`);
knurl.knurl_scene_destroy(scene);
