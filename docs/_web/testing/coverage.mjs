// A reporter for node --test: it fails where less than 90 % of a script's lines are run by tests.

import { globSync } from "node:fs";
import { basename } from "node:path";

const LEAST = 90;

/** @param {AsyncIterable<{type: string, data: any}>} events */
export default async function* report(events) {
  for await (const { type, data } of events) {
    if (type !== "test:coverage") continue;
    const covered = new Map(data.summary.files.map((file) => [basename(file.path), file.coveredLinePercent]));
    for (const script of globSync("_web/*.js")) {
      const share = covered.get(basename(script)) ?? 0;
      if (share >= LEAST) continue;
      process.exitCode = 1;
      yield `${script}: tests run ${share.toFixed(1)} % of the lines; it must be ${LEAST} % or more.\n`;
    }
  }
}
