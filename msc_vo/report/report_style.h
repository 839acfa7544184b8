// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// CSS of the report. Colours are variables, so that light, dark and print differ in one place.
inline constexpr char kReportStyle[] = R"css(
:root {
  color-scheme: light dark;
  --paper: #ffffff; --panel: #f6f7f9; --ink: #1b1f24; --faint: #66707c; --rule: #dfe3e8;
  --estimate: #1f6feb; --ground-truth: #8a929c; --error: #b4372f; --points: #1f6feb; --lines: #c2571a;
  --tracked: #3fa66b; --weak: #d8ab22; --dropped: #7a86a8; --unreadable: #8d5fb0; --predicted: #e07b28; --lost: #d03a3a;
  --axis-none: #c9991a; --axis-0: #d9534f; --axis-1: #3c9d5d; --axis-2: #3d7fd6;
  --stage-0: #6aa5e8; --stage-1: #f0a35e; --stage-2: #7cc396; --stage-3: #c49ae0;
  --stage-4: #e58a97; --stage-5: #9aa7b5; --mapping: #7b55c7;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    --paper: #14171b; --panel: #1c2026; --ink: #e6e9ed; --faint: #99a3af; --rule: #30363e;
    --estimate: #6fa8ff; --ground-truth: #9aa3ae; --error: #ff8b80; --points: #6fa8ff; --lines: #ff9d5c;
    --axis-none: #d3a93f; --axis-0: #e5736f; --axis-1: #5cbf7e; --axis-2: #6ba4ee;
    --stage-0: #3f78b8; --stage-1: #b9722f; --stage-2: #45915f; --stage-3: #8c61ab;
    --stage-4: #b05562; --stage-5: #66727f; --mapping: #a98bea;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: 28px 24px 48px; max-width: 1240px; background: var(--paper);
  color: var(--ink); font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif;
}
h1 { margin: 0; font-size: 26px; letter-spacing: -0.01em; }
h2 { margin: 34px 0 10px; font-size: 18px; }
p { margin: 4px 0 10px; color: var(--faint); }
code, pre { font: 13px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, monospace; }
pre { margin: 8px 0 0; padding: 12px 14px; overflow-x: auto; background: var(--panel);
  border: 1px solid var(--rule); border-radius: 8px; white-space: pre-wrap; }
.numbers { display: grid; gap: 10px; margin: 20px 0 0; padding: 0;
  grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); }
.numbers div { padding: 10px 14px; background: var(--panel); border: 1px solid var(--rule);
  border-radius: 8px; }
.numbers dt { color: var(--faint); font-size: 13px; }
.numbers dd { margin: 0; }
.numbers .value { font-size: 21px; font-weight: 600; font-variant-numeric: tabular-nums; }
.note { color: var(--faint); font-size: 12px; }
.facts { margin-top: 14px; }
.facts th, .facts td { text-align: left; vertical-align: baseline; }
.views { display: grid; gap: 14px; grid-template-columns: repeat(auto-fit, minmax(420px, 1fr)); }
figure { margin: 0; padding: 10px 12px 6px; border: 1px solid var(--rule); border-radius: 8px;
  break-inside: avoid; }
figcaption { color: var(--faint); font-size: 13px; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 16px; margin: 2px 0 0; padding: 0;
  list-style: none; color: var(--ink); }
.legend svg { width: 18px; height: 10px; margin-right: 6px; vertical-align: baseline; }
figure > svg { display: block; width: 100%; height: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 18px 4px 0; border-bottom: 1px solid var(--rule); text-align: right; }
th { color: var(--faint); font-weight: 500; }
th:first-child, td:first-child { text-align: left; }
summary { cursor: pointer; }
footer { margin-top: 36px; color: var(--faint); font-size: 13px; }
svg text { fill: var(--faint); font-size: 11px; }
.tick-x { text-anchor: middle; } .tick-y { text-anchor: end; } svg .name { font-size: 12px; }
.grid { stroke: var(--rule); stroke-width: 1; }
.curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.estimate { stroke: var(--estimate); } .ground-truth { stroke: var(--ground-truth); stroke-width: 2.6; }
.error { stroke: var(--error); } .points { stroke: var(--points); } .lines { stroke: var(--lines); }
.whole { stroke: var(--ink); stroke-width: 1; }
.stem { stroke: var(--mapping); stroke-width: 1; opacity: 0.5; }
.fill-mapping { fill: var(--mapping); }
.keyframe { fill: var(--paper); stroke: var(--estimate); stroke-width: 1.2; }
.map-line { stroke-width: 0.8; fill: none; } .axis-none { stroke: var(--axis-none); }
.scene-line { stroke-width: 1.2; stroke-linecap: round; fill: none; }
.scene-path { stroke: var(--ink); stroke-width: 2; fill: none; stroke-linejoin: round; }
.scene-keyframe { fill: var(--paper); stroke: var(--ink); stroke-width: 1.3; }
.axis-0 { stroke: var(--axis-0); } .axis-1 { stroke: var(--axis-1); }
.axis-2 { stroke: var(--axis-2); }
.start { fill: var(--paper); stroke: var(--ink); stroke-width: 2; }
.status-tracked { fill: var(--tracked); } .status-weak { fill: var(--weak); }
.status-dropped { fill: var(--dropped); } .status-unreadable { fill: var(--unreadable); }
 .status-predicted { fill: var(--predicted); } .status-lost { fill: var(--lost); }
.stage-0 { fill: var(--stage-0); } .stage-1 { fill: var(--stage-1); }
.stage-2 { fill: var(--stage-2); } .stage-3 { fill: var(--stage-3); }
.stage-4 { fill: var(--stage-4); } .stage-5 { fill: var(--stage-5); }
@media print {
  :root { color-scheme: light; }
  body { padding: 0; font-size: 11pt; }
  .views { grid-template-columns: 1fr 1fr; }
}
)css";

}  // namespace msc_vo
