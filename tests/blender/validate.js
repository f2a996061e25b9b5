// Has the Khronos validator judge every .glb of a folder. usage: node validate.js FOLDER MODULES
// MODULES: the folder with node_modules. Prints its words, each once; exits with 1 on errors or warnings.
// SPDX-License-Identifier: MIT
"use strict";
const fs = require("fs");
const path = require("path");
const [folder, modules] = process.argv.slice(2);
const validator = require(require.resolve("gltf-validator", { paths: [modules] }));
const KINDS = ["errors", "warnings", "infos", "hints"];

async function main() {
    const files = fs.readdirSync(folder).filter((name) => name.endsWith(".glb")).sort();
    const counts = [0, 0, 0, 0];
    const said = new Set();
    for (const name of files) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path.join(folder, name))));
        for (const { severity, code, message } of report.issues.messages) {
            counts[severity]++;
            said.add(`  ${KINDS[severity]}: ${code}: ${message}` + (severity < 2 ? ` (${name})` : ""));
        }
    }
    const sums = counts.map((count, severity) => `${count} ${KINDS[severity]}`).join(", ");
    console.log(`validator ${validator.version()}: ${files.length} files: ${sums}`);
    said.forEach((words) => console.log(words));
    process.exitCode = files.length === 0 || counts[0] + counts[1] > 0 ? 1 : 0;
}

main();
