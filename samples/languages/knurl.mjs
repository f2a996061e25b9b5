// The whole C interface in Node, read from api.json (./run mirror, or share/knurl/api.json) when it is loaded: functions,
// constants, and create(struct), which gives a struct with its defaults. Needs koffi 2.9 or newer: npm install koffi
// SPDX-License-Identifier: MIT
import { readFileSync } from "node:fs";
import koffi from "koffi";

export function load(apiFile, libraryFile) {
  const api = JSON.parse(readFileSync(apiFile, "utf8"));
  const library = koffi.load(libraryFile);
  for (const name of api.opaque) koffi.opaque(name);
  for (const [name, { type }] of Object.entries(api.types)) koffi.alias(name, type.includes("(*)") ? "void *" : type);

  // Pointers to structs and functions are `void *`: a buffer, or null.
  const member = (type) => {
    const array = /^(.*)\[(\d+)\]$/.exec(type);
    if (array) return koffi.array(array[1] === "char" ? "uint8_t" : array[1], Number(array[2]));
    return type === "const char *" ? "const char *" : /[*]/.test(type) ? "void *" : type;
  };
  const waiting = new Map(Object.entries(api.structs));
  const structs = {};
  while (waiting.size > 0) { // a struct after those that it holds
    for (const [name, { fields }] of waiting) {
      if (fields.some(({ type }) => waiting.has(type.replace(/\[.*/, "")) && type !== name)) continue;
      structs[name] = koffi.struct(name, Object.fromEntries(fields.map(({ name: field, type }) => [field, member(type)])));
      waiting.delete(name);
    }
  }
  const knurl = { koffi, structs };
  for (const [name, { value }] of Object.entries(api.constants)) knurl[name] = value;
  const parameter = ({ type }) => type === "const char *" ? type : /[*[]/.test(type) ? "void *" : type;
  for (const [name, { returns, parameters, variadic }] of Object.entries(api.functions)) {
    let call = null; // found at the first call: knurl_gltf's are not in this library
    knurl[name] = (...values) => (call ??= library.func(name, /[*]/.test(returns) && returns !== "const char *" ? "void *" : returns,
      [...parameters.map(parameter), ...(variadic ? ["..."] : [])]))(...values);
  }
  knurl.create = (name) => { // the bytes of a struct, with its defaults
    const bytes = Buffer.alloc(api.structs[name].size);
    if (api.functions[`${name}_init`]) knurl[`${name}_init`](bytes, bytes.length);
    return bytes;
  };
  knurl.get = (name, bytes) => koffi.decode(bytes, structs[name]);
  knurl.set = (name, bytes, values) => {
    koffi.encode(bytes, structs[name], { ...knurl.get(name, bytes), ...values });
    return bytes;
  };
  knurl.check = (result) => {
    if (result !== knurl.KNURL_OK) throw new Error(knurl.knurl_error_message());
  };
  return knurl;
}
