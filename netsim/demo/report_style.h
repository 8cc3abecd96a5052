#pragma once

#include <string_view>

namespace tandem::netsim::demo {

/// Style sheet of the report. Lines: Okabe and Ito's palette, which colour-blind people can tell apart; the three hands
/// also differ in width and dashes, so that they stay apart on grey paper. Dark mode changes the variables only.
inline constexpr std::string_view kReportStyle = R"css(
:root { color-scheme: light dark; --bg: #fff; --fg: #1c2128; --soft: #57606a; --rule: #d0d7de; --grid: #e7eaee; --panel: #f6f8fa;
  --trainer: #0072b2; --trainee: #d55e00; --slave: #9aa4ae; --third: #009e73; --mark: #8250df; --band: #f0e442; --band-strength: .28;
  --met: #1a7f37; --missed: #cf222e; }
@media (prefers-color-scheme: dark) { :root { --bg: #0d1117; --fg: #e6edf3; --soft: #9198a1; --rule: #3d444d; --grid: #21262d;
  --panel: #151b23; --trainer: #56b4e9; --trainee: #ff9d3c; --slave: #707a85; --third: #2bc99a; --mark: #b794f6; --band: #f0e442;
  --band-strength: .13; --met: #3fb950; --missed: #ff7b72; } }
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
figure { margin: 22px 0 30px; break-inside: avoid; } figcaption, p.facts, p.soft { max-width: 118ch; }
svg.figure { display: block; width: 100%; height: auto; } svg text { font: 12px system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif; fill: var(--fg); }
svg .tick { fill: var(--soft); font-size: 11px; } svg .mid { text-anchor: middle; } svg .end { text-anchor: end; }
svg .title { font-weight: 600; } svg .legend { font-size: 13px; }
svg .note { font-size: 11.5px; paint-order: stroke; stroke: var(--bg); stroke-width: 3.5px; stroke-linejoin: round; }
svg .grid { stroke: var(--grid); } svg .frame { fill: none; stroke: var(--rule); } svg .dot { fill: var(--mark); stroke: var(--bg); stroke-width: 1.5; }
svg .mark { stroke: var(--mark); stroke-dasharray: 2 3; stroke-width: 1.3; } svg .band { fill: var(--band); fill-opacity: var(--band-strength); }
svg .line { fill: none; stroke-linejoin: round; stroke-linecap: butt; stroke-width: 1.5; }
svg .slave { stroke: var(--slave); stroke-width: 4.2; stroke-opacity: .75; } svg .trainer { stroke: var(--trainer); }
svg .trainee { stroke: var(--trainee); stroke-dasharray: 6 2.5; } svg .alpha, svg .first { stroke: var(--trainer); }
svg .second { stroke: var(--trainee); stroke-dasharray: 7 3; } svg .third { stroke: var(--third); stroke-dasharray: 2.5 2.5; stroke-width: 2; }
@media print { :root { color-scheme: light; } body { padding: 0; max-width: none; font-size: 11pt; } nav { display: none; } h3 { break-before: page; }
  .scroll { overflow: visible; } table { font-size: 8pt; } th, td { padding: 1px 4px; } a { color: inherit; text-decoration: none; } pre { white-space: pre-wrap; } }
)css";

}  // namespace tandem::netsim::demo
