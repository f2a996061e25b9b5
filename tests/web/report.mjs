// The report of knurl verify, a page of its own, and its pictures in the documentation. SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { modules, open, tmp, tool } from "./harness.mjs";

export const cases = {
  // assets/pictures/verify.png and verify_dark.png are copies of its pictures
  async "axe finds nothing in verify's report, in light and dark, and it fits a phone"() {
    execFileSync(tool, ["verify", "--simulate", "--mass", "0.05", "--out", join(tmp, "verify")], { stdio: "ignore" });
    const url = pathToFileURL(join(tmp, "verify.html")).href;
    for (const colorScheme of ["light", "dark"]) {
      const tab = await open({ options: { viewport: { width: 1140, height: 1250 }, colorScheme }, url, waits: false });
      await tab.screenshot({ path: join(tmp, `verify${colorScheme === "dark" ? "_dark" : ""}.png`) });
      await tab.evaluate(readFileSync(join(modules, "axe-core/axe.min.js"), "utf8"));
      const { violations, passes } = await tab.evaluate(() => globalThis.axe.run());
      assert.deepEqual(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]), []);
      assert.ok(passes.length > 10, `${passes.length} rules`);
      assert.equal(await tab.locator("td.pass").count(), 21);
    }
    const phone = await open({ options: { viewport: { width: 390, height: 844 } }, url, waits: false });
    assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth), "it is wider than the window");
    await phone.screenshot({ path: join(tmp, "verify_phone.png") });
  },
};
