// The package's main module. SPDX-License-Identifier: MIT
export { Knurl, MOST } from "../core.js";
export { AT, METHODS, ROW } from "../rows.js";
