// The style sheet of the report page. Colours are variables, so that charts follow light and dark.
#pragma once

namespace copse {

inline constexpr const char* k_page_style = R"css(
:root{color-scheme:light dark;
--page:#fafaf7;--card:#fff;--ink:#1c211d;--soft:#5c665e;--rule:#e2e5de;--accent:#2f6b3f;--tint:#e6efe5;
--warn:#8a4b00;--warn-tint:#fdf1de;
--c0:#1f6f8b;--c1:#c8553d;--c2:#3d8b46;--c3:#8557a6;--c4:#b07c00;--c5:#0c8a80;--c6:#b83b7a;--c7:#5b6670}
@media(prefers-color-scheme:dark){:root{
--page:#141714;--card:#1c201d;--ink:#e6e9e4;--soft:#9aa59c;--rule:#2f352f;--accent:#8fcf9c;--tint:#26352a;
--warn:#f0bd75;--warn-tint:#33281a;
--c0:#6cb8d6;--c1:#f08a72;--c2:#82cb88;--c3:#c19ae0;--c4:#e0b454;--c5:#5fcabf;--c6:#ec86b6;--c7:#a9b3bc}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);
font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif;
font-variant-numeric:tabular-nums}
main,header,footer{max-width:1080px;margin:0 auto;padding:0 28px}
header{padding-top:44px}
.eyebrow{margin:0;color:var(--accent);font-weight:600;letter-spacing:.02em}
h1{margin:2px 0 4px;font-size:2.1rem;line-height:1.2;font-weight:650;letter-spacing:-.015em;overflow-wrap:anywhere}
.into{margin:0;color:var(--soft);overflow-wrap:anywhere}
h2{margin:48px 0 14px;font-size:1.25rem;font-weight:650;letter-spacing:-.005em}
h3{margin:28px 0 8px;font-size:1rem;font-weight:600}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,160px),1fr));gap:12px;margin:28px 0 0;padding:0}
.figures div{background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:14px 16px 12px}
.figures dt{color:var(--soft);font-size:.82rem}
.figures dd{margin:0;font-size:1.2rem;font-weight:600;line-height:1.3;overflow-wrap:anywhere}
.figures dd+dd{font-size:.82rem;font-weight:400;color:var(--soft)}
.scroll{overflow-x:auto;background:var(--card);border:1px solid var(--rule);border-radius:10px}
table{border-collapse:collapse;width:100%;font-size:.92rem}
th,td{padding:8px 10px;text-align:left;vertical-align:baseline;border-top:1px solid var(--rule)}
th:first-child,td:first-child{padding-left:16px}
th:last-child,td:last-child{padding-right:16px}
thead th{border-top:0;color:var(--soft);font-weight:500;font-size:.82rem;vertical-align:bottom}
thead th.n{white-space:normal}
tbody th{font-weight:500}
.n{text-align:right;white-space:nowrap}
.soft{color:var(--soft)}
code{font:.86em ui-monospace,SFMono-Regular,Menlo,"DejaVu Sans Mono",monospace;overflow-wrap:anywhere}
.time{width:38%;min-width:170px}
.lane{display:block;position:relative;height:12px;border-radius:3px;background:var(--tint)}
.lane span{position:absolute;top:0;bottom:0;min-width:2px;border-radius:3px;background:var(--accent)}
.warnings{margin:28px 0 0;padding:14px 20px;background:var(--warn-tint);border-left:4px solid var(--warn);
border-radius:0 10px 10px 0}
.warnings h2{margin:0 0 4px;font-size:1rem;color:var(--warn)}
.warnings ul{margin:0;padding-left:20px}
.warnings li{overflow-wrap:anywhere}
figure{margin:0 0 20px;background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:18px 18px 14px}
figure svg{display:block;width:100%;height:auto;max-height:720px}
figcaption{margin:10px 0 0;color:var(--soft);font-size:.9rem}
figcaption strong{color:var(--ink);font-weight:600}
figcaption:first-child{margin:0 0 8px}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:0 0 8px;padding:0;list-style:none;font-size:.9rem}
.legend svg{display:inline-block;width:26px;height:14px;vertical-align:-2px;margin-right:6px}
details{margin-top:10px;font-size:.9rem}
summary{cursor:pointer;color:var(--soft)}
details .scroll{margin-top:8px;max-height:340px;overflow:auto}
.plot{overflow-x:auto}
.plot svg{min-width:600px}
.chart text{font:12px system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif;fill:var(--soft)}
.chart .axis{font-weight:600}
.chart .labels text{fill:var(--ink)}
.grid path{stroke:var(--rule);stroke-width:1;fill:none}
.grid .minor{stroke-opacity:.45}
.series{fill:var(--c);stroke:var(--card);stroke-width:1}
.series .line{fill:none;stroke:var(--c);stroke-width:2;stroke-linejoin:round}
.c0{--c:var(--c0)}.c1{--c:var(--c1)}.c2{--c:var(--c2)}.c3{--c:var(--c3)}
.c4{--c:var(--c4)}.c5{--c:var(--c5)}.c6{--c:var(--c6)}.c7{--c:var(--c7)}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:20px}
.pictures figure{margin:0}
.pictures svg{background:#f6f7f3;border-radius:6px}
footer{padding:40px 28px 48px;color:var(--soft);font-size:.85rem}
@media print{body{background:#fff}.scroll,figure,.figures div{break-inside:avoid}}
)css";

}  // namespace copse
