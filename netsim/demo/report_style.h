#pragma once

#include <string_view>

namespace tandem::netsim::demo {

/// Style sheet of the report's text; netsim/plot/plot_style.h defines colours and figures.
inline constexpr std::string_view kReportStyle = R"css(
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 32px 28px 64px; max-width: 1160px; background: var(--bg); color: var(--fg);
  font: 16px/1.55 system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 6px; letter-spacing: -.01em; }
h2 { font-size: 22px; margin: 48px 0 10px; padding-top: 14px; border-top: 1px solid var(--rule); }
h3 { font-size: 19px; margin: 44px 0 6px; } h4 { font-size: 15px; margin: 0 0 6px; }
p { margin: 8px 0; max-width: 96ch; } a { color: var(--trainer); } .soft, figcaption, .facts { color: var(--soft); font-size: 14px; }
nav { display: flex; flex-wrap: wrap; gap: 4px 18px; font-size: 14px; margin: 14px 0 0; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", "Liberation Mono", monospace; font-size: 13px; }
pre { background: var(--panel); border: 1px solid var(--rule); border-radius: 6px; padding: 10px 12px; overflow-x: auto; margin: 8px 0 16px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: 3px 8px; text-align: right; border-bottom: 1px solid var(--grid); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } td:nth-child(2), th:nth-child(2) { text-align: left; color: var(--soft); }
thead th[colspan] { text-align: center; } thead th { border-bottom: 2px solid var(--rule); font-weight: 600; vertical-align: bottom; }
tr.section th { text-align: left; padding: 16px 8px 4px; font-weight: 600; border-bottom: 1px solid var(--rule); }
td.limit { color: var(--soft); text-align: left; padding-left: 0; font-size: 13px; } td.value { padding-right: 6px; padding-left: 22px; }
td.paper { font-weight: 600; } .met { color: var(--met); } .missed { color: var(--missed); font-weight: 700; } sup { line-height: 0; }
table.facts { width: auto; } table.facts td { text-align: right; } table.facts td:first-child { text-align: left; }
ol.notes { list-style: lower-alpha; padding-left: 26px; color: var(--soft); font-size: 14px; max-width: 118ch; } ol.notes li { margin: 3px 0; }
.headline { font-size: 21px; line-height: 1.35; margin: 6px 0 14px; } ul.missed { margin: 0 0 14px; padding-left: 22px; }
.first { display: flex; flex-wrap: wrap; gap: 20px 36px; align-items: flex-start; } .numbers { flex: 1 1 260px; display: grid; gap: 16px; }
.number { display: grid; border-left: 4px solid var(--trainer); padding: 2px 0 2px 14px; } .number b { font-size: 34px; line-height: 1.15; }
svg.setup { flex: 1 1 370px; max-width: 560px; } .player { max-width: 900px; } .player canvas, .player input { width: 100%; display: block; }
.player canvas { background: var(--panel); border-radius: 6px; } .player input { margin: 12px 0 4px; height: 28px; }
.player button, .player select { font: inherit; padding: 4px 10px; max-width: 100%; } #player-text { font-variant-numeric: tabular-nums; min-height: 3em; }
details { border-top: 1px solid var(--rule); padding: 10px 0; } summary { font-size: 17px; font-weight: 600; cursor: pointer; padding: 4px 0; }
.narrow { display: none; } h4 { margin-top: 22px; }
figure { margin: 22px 0 30px; break-inside: avoid; } figcaption, p.facts, p.soft { max-width: 118ch; }
@media (max-width: 640px) { body { padding: 18px 14px 48px; } h1 { font-size: 25px; } .wide { display: none; } .narrow { display: block; }
  .headline { font-size: 19px; } pre { white-space: pre-wrap; overflow-wrap: anywhere; } code { overflow-wrap: anywhere; }
  table.comparison, .comparison tbody { display: block; } .comparison thead, .comparison td.none, .comparison td.none[data-label], .comparison .none + .limit { display: none; }
  .comparison tr { display: grid; grid-template-columns: 1fr auto auto; gap: 0 8px; padding: 8px 0; border-bottom: 1px solid var(--grid); }
  .comparison td, .comparison tr.section th { border: 0; padding: 1px 0; white-space: normal; }
  .comparison tr:not(.section) td:first-child { grid-column: 1 / 3; font-weight: 600; } .comparison td[data-label]:not(.none) { grid-column: 1 / 3; display: flex; justify-content: space-between; padding: 1px 0; }
  .comparison td[data-label]::before { content: attr(data-label); color: var(--soft); } .comparison td.limit { grid-column: 3; min-width: 86px; }
  .comparison td.paper { grid-column: 1 / 3; } table.facts td, table.facts th { white-space: normal; padding: 3px 5px; } }
@media print { :root { color-scheme: light; } body { padding: 0; max-width: none; font-size: 11pt; } nav { display: none; } .player { display: none; }
  .scroll { overflow: visible; } table { font-size: 8pt; } th, td { padding: 1px 4px; } a { color: inherit; text-decoration: none; } pre { white-space: pre-wrap; } }
)css";

}  // namespace tandem::netsim::demo
