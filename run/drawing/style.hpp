#pragma once
// Private to the sources of run.
#include <string_view>

namespace abut::run {

/// Style sheet of a report: light or dark as its reader has it, black on white in print. It holds no character that XML
/// would have escaped.
inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light dark; --ink: #1b1b1a; --faint: #6b6a66; --line: #dcdbd6; --paper: #ffffff; --good: #1c7c3c;
  --bad: #b3361b; --blue: #2a78d6; --orange: #d9591f; --teal: #0a8f7c; --grey: #a5a49f; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e9e8e4; --faint: #a3a29d; --line: #3c3b38; --paper: #181817; --good: #6cc98a; --bad: #ff8f73;
    --blue: #6aa9f5; --orange: #ff9a66; --teal: #4fd0b8; --grey: #77766f; } }
@media print { :root { color-scheme: light; --ink: #000000; --faint: #444444; --line: #bbbbbb; --paper: #ffffff;
  --good: #00551c; --bad: #8a1d06; --blue: #1d5cab; --orange: #b3400b; --teal: #00695a; --grey: #999999; }
  section { break-inside: avoid; } }
body { font: 15px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper); max-width: 60em;
  margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin-bottom: 0; }
h2 { font-size: 1.15em; margin: 2em 0 0.5em; border-bottom: 1px solid var(--line); }
p.comment data { white-space: pre-line; }
p.faint, figcaption, td.faint { color: var(--faint); }
p.good, p.attention { font-size: 1.1em; border-left: 4px solid var(--good); padding-left: 0.7em; }
p.attention { border-color: var(--bad); }
.scroll, figure { overflow-x: auto; }
table { border-collapse: collapse; margin: 0.5em 0; }
th, td { text-align: left; vertical-align: top; padding: 0.15em 1.3em 0.15em 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
th:last-child, td:last-child { padding-right: 0; }
data { font-variant-numeric: tabular-nums; white-space: nowrap; }
data.words { white-space: normal; overflow-wrap: anywhere; }
figure { margin: 1em 0; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 27em), 1fr)); gap: 0 1em; }
svg { width: 100%; min-width: 36em; height: auto; font: 12px system-ui, sans-serif; }
.pictures svg { min-width: 410px; }
svg text { fill: var(--ink); }
svg text.name { paint-order: stroke; stroke: var(--paper); stroke-width: 3px; stroke-linejoin: round; }
.grid { stroke: var(--line); stroke-width: 1; }
.axis { stroke: var(--ink); stroke-width: 1; }
.curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.blue { stroke: var(--blue); }
.orange { stroke: var(--orange); }
.teal { stroke: var(--teal); }
.grey { stroke: var(--grey); stroke-width: 4; }
.ink { stroke: var(--ink); }
.load { stroke: #db2680; fill: #db2680; stroke-width: 1.5; }
.spring { stroke: var(--ink); fill: none; stroke-width: 1.5; stroke-linejoin: round; }
.gravity { stroke: var(--ink); fill: var(--ink); stroke-width: 1.2; }
.halo { stroke: var(--paper); fill: none; stroke-width: 4; stroke-linejoin: round; }
.bar { display: inline-block; height: 0.7em; background: var(--blue); print-color-adjust: exact; }
@media (max-width: 40em) { body { font-size: 14px; } th, td { padding-right: 0.8em; } }
summary { cursor: pointer; color: var(--faint); }
)css";

}  // namespace abut::run
