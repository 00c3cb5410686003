// SPDX-License-Identifier: MIT
/// The page's styles.
#pragma once

#include <string_view>

namespace shaftcull::cli {

/// Inks are those of plot.hpp, in its order. Blue and vermilion are Okabe and Ito's, which colour-blind people tell
/// apart.
inline constexpr std::string_view page_style = R"(:root {
  color-scheme: light dark;
  --page: #fbfbfa; --card: #ffffff; --line: #e3e3e0;
  --ink-1: #1c1c1a; --ink-2: #6a6a66; --ink-3: #e6e6e2;
  --ink-4: #7a7a76; --ink-5: #a06a00; --ink-6: #0067a5; --ink-7: #c24a00; --ink-8: #7a3d9a;
  --good: #00705a;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #161615; --card: #1f1f1e; --line: #353533;
    --ink-1: #ecece8; --ink-2: #a3a39d; --ink-3: #353533;
    --ink-4: #a9a9a3; --ink-5: #e6a117; --ink-6: #5cb8ee; --ink-7: #ff8c4d; --ink-8: #c792ea;
    --good: #3fc9a5;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink-1);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1240px; margin: 0 auto; padding: 32px 24px 64px; }
h1 { font-size: 26px; line-height: 1.2; margin: 0; }
h2 { font-size: 17px; line-height: 1.3; margin: 0; }
header p, figure > p, section > p, .note { margin: 4px 0 0; color: var(--ink-2); }
.note { margin-bottom: 16px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(200px, 1fr)); gap: 16px; margin: 24px 0; }
.tiles div { border-left: 3px solid var(--ink-6); padding: 2px 0 2px 12px; }
.tiles b { display: block; font-size: 26px; line-height: 1.2; }
.tiles span { color: var(--ink-2); }
.figures { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 16px; }
figure, section { margin: 0; padding: 20px;
  background: var(--card); border: 1px solid var(--line); border-radius: 8px; }
figure { display: flex; flex-direction: column; }
figure svg { display: block; width: 100%; height: auto; margin-top: auto; padding-top: 12px;
  overflow: visible; }
figure svg text, figure svg tspan { font-family: system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
figure.wide { grid-column: 1 / -1; }
section { margin-top: 16px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; margin-top: 12px; }
th { text-align: left; font-weight: 600; color: var(--ink-2); }
th, td { padding: 5px 16px 5px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
tr:last-child td { border-bottom: 0; }
.n { text-align: right; white-space: nowrap; }
.met { color: var(--good); }
.below { font-weight: 600; }
.none { color: var(--ink-2); }
dl { margin: 12px 0 0; }
dl div { display: flex; gap: 16px; padding: 3px 0; }
dt { flex: 0 0 140px; color: var(--ink-2); }
dd { margin: 0; }
@media (max-width: 900px) { .figures { grid-template-columns: minmax(0, 1fr); } }
)";

}  // namespace shaftcull::cli
