/** A reporter of vitest: writes how long the files of each project took, in milliseconds. */
import { writeFileSync } from "node:fs";

export default class ProjectTimes {
  onTestRunEnd(modules) {
    const times = {};
    for (const module of modules) {
      const { name } = module.project;
      times[name] = (times[name] ?? 0) + module.diagnostic().duration;
    }
    const path = process.env.TURNLEAF_PROJECT_TIMES;
    if (path) writeFileSync(path, JSON.stringify(times));
  }
}
