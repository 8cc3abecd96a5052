#pragma once

#include <string_view>

namespace tandem::netsim::demo {

/// Style sheet of the report's text; that of its figures and the colours are in netsim/plot/plot_style.h.
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
figure { margin: 22px 0 30px; break-inside: avoid; } figcaption, p.facts, p.soft { max-width: 118ch; }
@media print { :root { color-scheme: light; } body { padding: 0; max-width: none; font-size: 11pt; } nav { display: none; } h3 { break-before: page; }
  .scroll { overflow: visible; } table { font-size: 8pt; } th, td { padding: 1px 4px; } a { color: inherit; text-decoration: none; } pre { white-space: pre-wrap; } }
)css";

}  // namespace tandem::netsim::demo
