#include "report/assets.h"

namespace probegi::tool {

const std::string_view kReportStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #f7f6f3; --card: #ffffff; --ink: #1d1b18; --quiet: #625d55; --line: #dedad2; --accent: #a8450f;
}
@media (prefers-color-scheme: dark) {
  :root { --page: #141311; --card: #1e1c19; --ink: #efebe4; --quiet: #a8a197; --line: #35312c; --accent: #ffa869; }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
header, main, footer { max-width: 1560px; margin: 0 auto; padding: 0 clamp(14px, 3vw, 40px); }
header { padding-top: clamp(22px, 4vw, 48px); }
h1 { font-size: clamp(1.6rem, 4vw, 2.4rem); line-height: 1.15; margin: 0; letter-spacing: -0.02em; }
h2 { font-size: clamp(1.3rem, 3vw, 1.8rem); line-height: 1.2; margin: 0; letter-spacing: -0.01em; overflow-wrap: anywhere; }
h3 { font-size: 1.05rem; margin: 2rem 0 0.7rem; }
p { margin: 0.4rem 0; max-width: 75ch; }
.quiet { color: var(--quiet); }
a { color: var(--accent); }
nav ul { list-style: none; display: flex; flex-wrap: wrap; gap: 0.4rem 1.2rem; padding: 0; margin: 0.8rem 0 0; }
section { margin-top: clamp(28px, 5vw, 56px); padding-top: clamp(20px, 3vw, 32px); border-top: 1px solid var(--line); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 150px), 1fr)); gap: 10px; margin: 1.1rem 0; padding: 0; }
.tiles div { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 0.7rem 0.9rem; display: flex; flex-direction: column; }
.tiles dd { margin: 0; order: -1; font-size: 1.45rem; font-weight: 650; font-variant-numeric: tabular-nums; letter-spacing: -0.01em; }
.tiles dt { color: var(--quiet); font-size: 0.85rem; line-height: 1.35; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 540px), 1fr)); gap: 18px; margin-top: 1.2rem; }
.gallery { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 460px), 1fr)); gap: 18px; }
.gallery.maps { grid-template-columns: repeat(auto-fit, minmax(min(100%, 320px), 1fr)); }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 10px; overflow: hidden; }
figure img { display: block; width: 100%; height: auto; }
.zoom { display: block; width: 100%; margin: 0; padding: 0; border: 0; background: none; cursor: zoom-in; }
.verdict { font-size: 1.2rem; font-weight: 600; line-height: 1.4; margin: 0.9rem 0; padding: 0.8rem 1.1rem; border-left: 6px solid var(--tone); border-radius: 6px; background: var(--card); }
.verdict.matches { --tone: #2f9e57; } .verdict.differs { --tone: #d9930d; } .verdict.noisy { --tone: #7a7f8a; } .verdict.leaks { --tone: #d8352a; }
.view + .view { margin-top: 2.5rem; }
h4 { font-size: 0.95rem; margin: 1.6rem 0 0.7rem; color: var(--quiet); font-weight: 600; }
.exposure { display: flex; flex-wrap: wrap; align-items: center; gap: 0.4rem 0.9rem; margin: 1rem 0; font-size: 0.9rem; color: var(--quiet); }
.exposure label { display: flex; align-items: center; gap: 0.6rem; } .exposure input { width: min(46vw, 320px); accent-color: var(--accent); }
.exposure output { font-variant-numeric: tabular-nums; min-width: 12em; }
button { font: inherit; }
.exposure button, .tools button { color: var(--ink); background: var(--page); border: 1px solid var(--line); border-radius: 7px; padding: 0.2rem 0.7rem; cursor: pointer; }
.key { list-style: none; display: flex; flex-wrap: wrap; gap: 0.3rem 1.3rem; padding: 0; margin: 0 0 0.9rem; font-size: 0.9rem; }
.key span { display: inline-block; width: 0.85em; height: 0.85em; border-radius: 50%; margin-right: 0.45em; }
dialog { width: min(96vw, 1960px); max-width: none; max-height: 96vh; padding: 0.9rem 1.1rem; border: 1px solid var(--line); border-radius: 12px; background: var(--card); color: var(--ink); }
dialog::backdrop { background: rgb(0 0 0 / 0.6); }
.tools { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 0.5rem; }
dialog output { display: block; min-height: 3em; margin: 0.5rem 0; font-size: 0.9rem; font-variant-numeric: tabular-nums; white-space: pre-line; }
.scroll { overflow: auto; max-height: 78vh; } .scroll canvas { display: block; image-rendering: pixelated; cursor: crosshair; }
figcaption { padding: 0.6rem 0.9rem 0.75rem; font-size: 0.9rem; color: var(--quiet); }
figcaption strong { color: var(--ink); }
.slider { background: var(--card); border: 1px solid var(--line); border-radius: 10px; overflow: hidden; }
.stage { position: relative; --split: 50%; touch-action: pan-y; user-select: none; -webkit-user-select: none; cursor: ew-resize; }
.stage img { display: block; width: 100%; height: auto; pointer-events: none; }
.stage .right { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--split)); }
.stage .bar { position: absolute; top: 0; bottom: 0; left: var(--split); width: 2px; margin-left: -1px; background: #fff; box-shadow: 0 0 0 1px rgb(0 0 0 / 0.35); pointer-events: none; }
.stage .bar::after {
  content: "\2194"; position: absolute; top: 50%; left: 50%; width: 38px; height: 38px; margin: -19px 0 0 -19px; border-radius: 50%;
  background: #fff; color: #222; font-size: 20px; line-height: 36px; text-align: center; box-shadow: 0 1px 6px rgb(0 0 0 / 0.45);
}
.stage input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; pointer-events: none; }
.stage:has(input:focus-visible) { outline: 3px solid var(--accent); outline-offset: -3px; }
.tag { position: absolute; top: 10px; padding: 0.1rem 0.6rem; border-radius: 99px; background: rgb(0 0 0 / 0.62); color: #fff; font-size: 0.85rem; pointer-events: none; }
.tag.a { left: 10px; } .tag.b { right: 10px; }
.choose { display: flex; flex-wrap: wrap; gap: 0.5rem 1.2rem; justify-content: space-between; padding: 0.6rem 0.9rem 0.75rem; font-size: 0.9rem; }
.choose label { display: flex; gap: 0.5rem; align-items: center; color: var(--quiet); }
select { font: inherit; color: var(--ink); background: var(--page); border: 1px solid var(--line); border-radius: 7px; padding: 0.25rem 0.4rem; max-width: 100%; }
.legend { display: flex; align-items: center; gap: 0.7rem; max-width: 420px; margin: 0 0 0.9rem; font-size: 0.85rem; color: var(--quiet); }
.legend span.ramp { flex: 1; height: 12px; border-radius: 6px; border: 1px solid var(--line); }
.tables { columns: 420px; column-gap: 18px; margin-top: 1.6rem; }
.sheet { break-inside: avoid; margin-bottom: 18px; background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 0.3rem 0.9rem 0.7rem; overflow-x: auto; }
.sheet p { font-size: 0.85rem; color: var(--quiet); margin: 0.5rem 0 0.2rem; }
table { border-collapse: collapse; width: 100%; font-size: 0.92rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: 650; padding: 0.6rem 0 0.4rem; }
th, td { padding: 0.32rem 0.8rem 0.32rem 0; text-align: right; vertical-align: top; border-top: 1px solid var(--line); }
th:last-child, td:last-child { padding-right: 0; }
th:first-child { text-align: left; font-weight: 500; }
thead th { color: var(--quiet); font-weight: 500; border-top: 0; }
footer { padding-top: 28px; padding-bottom: 40px; color: var(--quiet); font-size: 0.9rem; }
footer div { border-top: 1px solid var(--line); padding-top: 18px; }
code { font: 0.92em/1.5 ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
noscript p { color: var(--accent); }
@media print { .slider, .exposure, nav { display: none; } section { break-inside: avoid; } }
)css";

}  // namespace probegi::tool
