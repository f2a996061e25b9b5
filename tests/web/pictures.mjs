// The pictures of the page, and a check that those of the documentation are up to date. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { open, root, tmp } from "./harness.mjs";


const SIZES = {
  web: { viewport: { width: 1280, height: 800 } },
  web_phone: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
};

export const cases = {
  async "the documentation's pictures show this page"() {
    const said = {};
    for (const [name, size] of Object.entries(SIZES)) {
      for (const colorScheme of ["light", "dark"]) {
        const tab = await open({ options: { ...size, colorScheme } });
        await (name === "web" ? tab.selectOption("#preset", { label: "S1 pushes" }) : null);
        await tab.waitForSelector("html[data-surveyed]");
        await tab.waitForFunction(() => /cycles crossed[3-9]\d\d/.test(document.querySelector("#numbers").textContent));
        assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "it is wider than the window");
        await tab.screenshot({ path: join(tmp, `${name}${colorScheme === "dark" ? "_dark" : ""}.png`) });
        said.page = await tab.evaluate(() => [...document.querySelectorAll("h1, header p, label > span, :not(fieldset) > label, button, summary, legend, dt")]
          .map((part) => part.textContent.trim().replace(/\s+/g, " ")));
      }
    }
    writeFileSync(join(tmp, "web.json"), JSON.stringify(said));
    const check = spawnSync("/usr/bin/python3", ["-B", join(root, "samples/study/drawn.py"), "--check",
      join(root, "assets/pictures/web.data"), join(tmp, "web.json")], { encoding: "utf8" });
    assert.equal(check.status, 0, `${check.stdout}${check.stderr}the page has changed since its pictures: copy ${tmp}/web*.png to ` +
      `assets/pictures, and write web.data by drawn.py from ${tmp}/web.json`);
  },
};
