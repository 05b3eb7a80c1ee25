// SPDX-License-Identifier: MIT
#include "app/study/page.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/study/report.h"
#include "app/study/study.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

std::string base64(std::string_view bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[word >> (18 - 6 * k) & 63u];
    }
  }
  return text;
}

// "" where there is no such file.
std::string dataUrl(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return "";
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  return "data:image/png;base64," + base64(bytes);
}

// The page's own code: a plot with a logarithmic cost, and what a click on a point shows.
constexpr const char* kPage = R"page(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Cost and error</title><style>
body{font:15px sans-serif;margin:1.5em;background:#fff;color:#222;max-width:1400px}
svg{width:100%;max-width:900px;height:auto;background:#fafafa}
circle{cursor:pointer}circle:focus{outline:2px solid #000}
#shown{display:flex;gap:1em;flex-wrap:wrap}#shown img{max-width:48%;image-rendering:pixelated}
pre{background:#eee;padding:.6em;white-space:pre-wrap}table{border-collapse:collapse}
td,th{padding:.2em .7em;text-align:right;border-bottom:1px solid #ddd}tr.on{background:#ffe9b8}
tbody tr{cursor:pointer}
</style></head><body><h1>Cost and error</h1><p id="about"></p><div id="plot"></div>
<h2 id="name"></h2><div id="shown"></div><pre id="command"></pre>
<table id="table"></table>
<script id="data" type="application/json">@DATA@</script><script>
const all = JSON.parse(document.getElementById('data').textContent);
const points = all.filter(r => r.cost > 0 && r.errors.length);
const colours = {opengl: '#0072B2', vulkan: '#D55E00'};
const colour = r => colours[r.backend] || '#009E73';
const W = 900, H = 520, L = 70, B = 55, T = 15, R = 20;
const lx = points.map(r => Math.log10(r.cost)), ly = points.map(r => r.rmse);
const x0 = Math.min(...lx) - .05, x1 = Math.max(...lx) + .05;
const y0 = Math.min(...ly) * .95, y1 = Math.max(...ly) * 1.03;
const X = c => L + (Math.log10(c) - x0) / (x1 - x0) * (W - L - R);
const Y = e => H - B - (e - y0) / (y1 - y0) * (H - B - T);
let svg = `<svg viewBox="0 0 ${W} ${H}" role="img" aria-label="RMSE against cost">`;
for (let k = 0; k <= 5; ++k) {
  const c = 10 ** (x0 + (x1 - x0) * k / 5), e = y0 + (y1 - y0) * k / 5;
  svg += `<line x1="${X(c)}" x2="${X(c)}" y1="${T}" y2="${H - B}" stroke="#ddd"/>` +
    `<text x="${X(c)}" y="${H - B + 18}" text-anchor="middle" font-size="12">${c.toPrecision(3)}</text>` +
    `<line x1="${L}" x2="${W - R}" y1="${Y(e)}" y2="${Y(e)}" stroke="#ddd"/>` +
    `<text x="${L - 8}" y="${Y(e) + 4}" text-anchor="end" font-size="12">${e.toFixed(4)}</text>`;
}
svg += `<text x="${W / 2}" y="${H - 12}" text-anchor="middle">cost of the effects, ms (log)</text>` +
  `<text transform="translate(16 ${H / 2}) rotate(-90)" text -
                              anchor = "middle" > RMSE</ text>`;
for (const b of new Set(points.map(r = > r.backend))) {
  const front = points.filter(r = > r.backend == = b && r.front).sort((p, q) = > p.cost - q.cost);
  svg += `< polyline fill = "none" stroke = "${colours[b] || '#009E73'}" stroke - width =
                                                "2" points =
                                                    "` +
                                                    front.map(r = > X(r.cost) + ',' + Y(r.rmse))
                                                        .join(' ') +
                                                    '"/>';
}
points.forEach((r,
                i) = >
                     svg += `<circle tabindex = "0" data - i = "${i}" cx = "${X(r.cost)}" ` +
  `cy = "${Y(r.rmse)}" r = "${r.front ? 6 : 3.5}" fill = "${colour(r)}" fill -
                                                          opacity = "${r.front ? 1 : .5}">` +
  `<title>
                                ${r.backend} ${r.name}
               : ${r.cost.toFixed(2)} ms, ${r.rmse.toFixed(4)}</ title></ circle>`);
document.getElementById('plot').innerHTML = svg + '</svg>';
const text = (id, t) = > document.getElementById(id).textContent = t;
function show(i) {
  const r = points[i];
  text(
      'name', `${r.backend}
      : $ { r.name }`);
  text('command', r.command);
  document.getElementById('shown').innerHTML =
      [ r.picture, r.error_map ].filter(Boolean).map(p = > `<img src = "${p}" alt = "">`).join('');
  document.querySelectorAll('tr[data-i]').forEach(t = > t.className = t.dataset.i == i ? 'on' : '');
}
const f = (v, n) = > v.toFixed(n);
document.getElementById('table').innerHTML =
    '<thead><tr><th>setting</th><th>backend</th><th>ms</th>' +
    '<th>spread</th><th>RMSE</th><th>bias</th><th>99 %</th><th>SSIM</th><th>front</th></tr></thead><tbody>' +
    points
        .map((r, i) = > `<tr data - i = "${i}"><td> ${r.name}</ td><td> ${r.backend}</ td><td> ${
                            f(r.cost, 2)}</ td>` +
    `<td>
                                ${f(r.spread, 2)}</ td><td>
                                    ${f(r.rmse, 4)}</ td>
                            <td>
                                ${f(r.errors.reduce((s, e) = > s + e.bias, 0) / r.errors.length,
                                    4)}</ td>` +
    `<td>
                                    ${f(Math.max(... r.errors.map(e = > e.percentile_99)), 3)}</ td>
                            <td>
                                ${f(r.errors.reduce((s, e) = > s + e.ssim, 0) / r.errors.length,
                                    4)}</ td>` +
    `<td>
                                    ${r.front ? '*' : ''}</ td></ tr>`)
        .join('') +
    '</tbody>';
for (const e of document.querySelectorAll('[data-i]')) {
  e.addEventListener('click', () = > show(e.dataset.i));
  e.addEventListener(
      'keydown', k = > {
        if (k.key == = 'Enter') show(e.dataset.i);
      });
}
if (points.length) {
  text(
      'about', `${points.length} settings;
      ${[... new Set(points.map(r = > r.backend + ' on ' + r.device + ', ' + r.clock + ' clock'))].join('; ')}; ` +
    `${points[0].machine}; commit ${points[0].commit}.Pictures
      : the first camera, and its error
      : blue too dark, orange too bright.`);
  show(Math.max(0, points.findIndex(r = > r.front)));
}
</script></body></html>
)page";

}  // namespace

std::string pageData(const fs::path& folder, std::span<const Record> records, bool pictures) {
  std::vector<bool> front(records.size());
  for (const char* backend : {"opengl", "vulkan", "null"}) {
    std::vector<Record> own;
    std::vector<size_t> index;
    for (size_t i = 0; i < records.size(); ++i) {
      if (records[i].backend != backend) continue;
      own.push_back(records[i]);
      index.push_back(i);
    }
    for (const size_t i : paretoFront(own)) front[index[i]] = true;
  }
  json all = json::array();
  for (size_t i = 0; i < records.size(); ++i) {
    const Record& r = records[i];
    json setting = json::object(), errors = json::array();
    for (const auto& [name, value] : r.setting) setting[name] = value;
    for (const CameraErrors& e : r.errors) {
      errors.push_back({{"camera", e.camera},
                        {"rmse", e.rmse},
                        {"mean_absolute", e.meanAbsolute},
                        {"bias", e.bias},
                        {"percentile_99", e.percentile99},
                        {"ssim", e.ssim}});
    }
    json one = {{"name", nameOf(r.setting)}, {"setting", setting},
                {"backend", r.backend},      {"device", r.device},
                {"driver", r.driver},        {"clock", r.clock},
                {"machine", r.machine},      {"commit", r.commit},
                {"command", r.command},      {"errors", errors},
                {"rmse", r.rmse()},          {"cost", r.cost()},
                {"spread", r.spread()},      {"milliseconds", r.milliseconds},
                {"front", front[i] ? 1 : 0}};
    if (r.flicker) one["flicker"] = *r.flicker;
    if (pictures) {
      one["picture"] = dataUrl(pictureOf(folder, r));
      one["error_map"] = dataUrl(errorMapOf(folder, r));
    }
    all.push_back(std::move(one));
  }
  return all.dump(pictures ? -1 : 1);
}

std::string pageOf(const fs::path& folder, std::span<const Record> records) {
  std::string data = pageData(folder, records, true);
  // Nothing in it may end the script element.
  for (size_t at = 0; (at = data.find("</", at)) != std::string::npos; at += 3) {
    data.replace(at, 2, "<\\/");
  }
  std::string page = kPage;
  page.replace(page.find("@DATA@"), 6, data);
  return page;
}

}  // namespace grisaille::app::study
