#pragma once
// Private to the sources of run.
#include <string_view>

namespace abut::run {

/// The page of an animation, which asks for nothing, and draws with WebGL 2: `animation_head`, `animation_script` and
/// `animation_body`, from the style sheet to the first frame. Below them stand a script element of id "common" and one
/// of class "frame" for each frame, as Animation writes them. A page without its end is drawn, too, as far as its
/// frames are whole.
inline constexpr std::string_view animation_head = R"html(
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<style>
:root { color-scheme: light dark; --ink: #1b1b1a; --faint: #6b6a66; --line: #dcdbd6; --paper: #ffffff; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e9e8e4; --faint: #a3a29d; --line: #3c3b38; --paper: #181817; } }
* { box-sizing: border-box; }
body { font: 15px/1.4 system-ui, sans-serif; color: var(--ink); background: var(--paper); margin: 0; padding: 0.6em 1em;
  height: 100vh; display: flex; flex-direction: column; gap: 0.4em; }
h1 { font-size: 1.3em; margin: 0; }
p { margin: 0; color: var(--faint); white-space: pre-line; max-height: 4.2em; overflow: auto; }
#stage { position: relative; flex: 1; min-height: 12em; border: 1px solid var(--line); overflow: hidden; }
canvas { position: absolute; width: 100%; height: 100%; touch-action: none; cursor: grab; }
#stage svg { position: absolute; left: 0.6em; bottom: 0.4em; width: 68px; height: 68px; stroke: var(--ink);
  font-size: 12px; pointer-events: none; }
#stage svg text { stroke: none; fill: var(--ink); text-anchor: middle; }
#length { position: absolute; right: 1em; bottom: 0.5em; border-bottom: 2px solid var(--ink); text-align: center;
  font-size: 13px; pointer-events: none; }
.name { position: absolute; transform: translate(-50%, -50%); font-size: 13px; padding: 0 0.3em; border-radius: 3px;
  background: color-mix(in srgb, var(--paper) 70%, transparent); pointer-events: none; white-space: nowrap; }
.row { display: flex; flex-wrap: wrap; align-items: center; gap: 0.3em 1em; }
#slider { flex: 1; min-width: 8em; }
#play { width: 5em; }
#time { font-variant-numeric: tabular-nums; min-width: 15em; }
#hint { color: var(--faint); }
#bar { display: inline-block; width: 12em; height: 0.8em; print-color-adjust: exact; }
label { white-space: nowrap; }
</style>
)html";

inline constexpr std::string_view animation_body = R"html(</head>
<body>
<h1 id="title"></h1>
<p id="comment"></p>
<div id="stage"><canvas id="canvas"></canvas><svg id="axes"></svg><div id="length"></div></div>
<div class="row"><button id="play">Play</button><input id="slider" type="range" min="0" value="0" aria-label="frame"><span
id="time"></span></div>
<div class="row"><span>0 <span id="bar"></span> <span id="end"></span></span>
<label><input id="cells" type="checkbox"> edges of cells</label><label><input id="names" type="checkbox"> names</label>
<label>lasts <select id="seconds"><option>4</option><option selected>8</option><option>16</option><option>60</option></select>
s</label><span id="marks"></span><span id="hint"></span></div>
<noscript>The animation needs JavaScript.</noscript>
)html";

}  // namespace abut::run
