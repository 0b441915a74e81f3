#include "lib/formats/export/html.h"

#include "lib/formats/export/html_chart.h"
#include "lib/formats/export/html_style.h"
#include "lib/formats/export/html_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <span>

#include <fmt/format.h>

namespace copse {
namespace {

std::string base_name(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  return name.empty() ? path : name;
}

// "oak.glb", "oak.glb and 3 more"
std::string names_of(const std::vector<FileRecord>& files) {
  if (files.empty()) return {};
  std::string text = base_name(files.front().path);
  if (files.size() == 2) text += fmt::format(" and {}", base_name(files[1].path));
  if (files.size() > 2) text += fmt::format(" and {} more", files.size() - 1);
  return text;
}

std::uint64_t bytes_of(const std::vector<FileRecord>& files) {
  std::uint64_t sum = 0;
  for (const FileRecord& file : files) sum += file.bytes;
  return sum;
}

void add_figure(std::string& out, const std::string& name, const std::string& value,
                const std::string& note = {}) {
  out += fmt::format("<div><dt>{}</dt><dd>{}</dd>", name, value);
  if (!note.empty()) out += fmt::format("<dd>{}</dd>", note);
  out += "</div>";
}

// What the run went through: the stage with the most items; bytes are told elsewhere.
const StageRecord* largest_stage(const Report& report) {
  const StageRecord* best = nullptr;
  for (const StageRecord& stage : report.stages) {
    if (stage.unit.empty() || stage.unit == "bytes" || stage.items == 0) continue;
    if (best == nullptr || stage.items > best->items) best = &stage;
  }
  return best;
}

double seconds_of(const StageRecord& stage) {
  return std::isfinite(stage.seconds) ? std::max(stage.seconds, 0.0) : 0;
}

// The stage that makes the pictures of this very page: no part of the work, so it is left out of its time,
// its rate and its stages' shares.
bool draws_the_page(const StageRecord& stage) {
  return stage.name == "draw";
}

double drawing_seconds(const Report& report) {
  double seconds = 0;
  for (const StageRecord& stage : report.stages) {
    if (draws_the_page(stage)) seconds += seconds_of(stage);
  }
  return std::min(seconds, report.seconds);
}

void add_key_figures(std::string& out, const Report& report) {
  const double drawing = drawing_seconds(report), working = report.seconds - drawing;
  out += "<dl class=\"figures\">";
  add_figure(out, "time", show_seconds(working),
             drawing > 0 ? fmt::format("and {} to draw this page", show_seconds(drawing)) : std::string());
  if (report.peak_bytes > 0) add_figure(out, "peak memory", show_bytes(report.peak_bytes));
  const std::uint64_t in = bytes_of(report.inputs), written = bytes_of(report.outputs);
  if (in > 0) add_figure(out, report.inputs.size() > 1 ? "inputs" : "input", show_bytes(in));
  if (written > 0) {
    std::string note;
    // Several outputs are no share of what they were made of, and an ecosystem names its trees.
    const bool is_share = report.outputs.size() == 1 &&
                          std::filesystem::path(report.outputs.front().path).extension() != ".eco";
    if (in > 0 && is_share)
      note = show_number(100.0 * static_cast<double>(written) / static_cast<double>(in)) + " % of the input";
    add_figure(out, report.outputs.size() > 1 ? "outputs" : "output", show_bytes(written), note);
  }
  if (const StageRecord* stage = largest_stage(report)) {
    std::string note;
    if (working > 0) note = show_rate(static_cast<double>(stage->items) / working) + " a second";
    add_figure(out, escape_html(stage->unit), show_count(stage->items), note);
  }
  if (!report.errors.empty()) {
    const ErrorRecord& e = report.errors.front();
    const std::string unit =
        e.unit.empty() || e.unit == "ratio" ? "" : fmt::format(" {}", escape_html(e.unit));
    add_figure(out, escape_html(e.name), show_number(e.value) + unit,
               e.max ? fmt::format("at most {}{}", show_number(*e.max), unit) : std::string());
  }
  out += "</dl>\n";
}

void add_warnings(std::string& out, const Report& report) {
  if (report.warnings.empty()) return;
  out += "<section class=\"warnings\"><h2>Warnings</h2><ul>";
  for (const std::string& warning : report.warnings) out += fmt::format("<li>{}</li>", escape_html(warning));
  out += "</ul></section>\n";
}

// Stages follow one another; where their times add up to more than the whole they were nested, and all bars
// begin at the left.
void add_stages(std::string& out, const Report& report) {
  if (report.stages.empty()) return;
  double sum = 0, longest = 0;
  for (const StageRecord& stage : report.stages) {
    if (draws_the_page(stage)) continue;
    sum += seconds_of(stage);
    longest = std::max(longest, seconds_of(stage));
  }
  const double working = report.seconds - drawing_seconds(report);
  const bool in_sequence = working <= 0 || sum <= 1.02 * working;
  const double whole = in_sequence ? std::max(sum, working) : longest;
  out +=
      "<section><h2>Stages</h2><div class=\"scroll\"><table><thead><tr><th scope=\"col\">stage</th>"
      "<th scope=\"col\" class=\"time\">when</th><th scope=\"col\" class=\"n\">time</th>"
      "<th scope=\"col\" class=\"n\">share</th><th scope=\"col\" class=\"n\">went through</th>"
      "<th scope=\"col\" class=\"n\">a second</th></tr></thead><tbody>";
  double start = 0;
  for (const StageRecord& stage : report.stages) {
    const double seconds = seconds_of(stage), scale = whole > 0 ? 100 / whole : 0;
    const bool barred = !draws_the_page(stage) && whole > 0;
    out += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"time\">", escape_html(stage.name));
    if (barred)
      out += fmt::format(
          "<span class=\"lane\" aria-hidden=\"true\"><span "
          "style=\"left:{:.2f}%;width:{:.2f}%\"></span></span>",
          in_sequence ? start * scale : 0.0, seconds * scale);
    out += fmt::format("</td><td class=\"n\">{}</td><td class=\"n soft\">{}</td>", show_seconds(seconds),
                       barred ? show_number(seconds * scale, 2) + " %" : "");
    const bool counted = !stage.unit.empty();
    out += fmt::format("<td class=\"n\">{}</td><td class=\"n soft\">{}</td></tr>",
                       counted ? show_count(stage.items) + " " + escape_html(stage.unit) : "",
                       counted && seconds > 0 ? show_rate(static_cast<double>(stage.items) / seconds) : "");
    if (barred) start += seconds;
  }
  out += "</tbody></table></div></section>\n";
}

std::string optional_number(const std::optional<double>& value) {
  return value ? show_number(*value) : "";
}

void add_errors(std::string& out, const Report& report) {
  if (report.errors.empty()) return;
  out +=
      "<section><h2>Errors</h2><div class=\"scroll\"><table><thead><tr><th scope=\"col\">measure</th>"
      "<th scope=\"col\" class=\"n\">value</th><th scope=\"col\" class=\"n\">rms</th>"
      "<th scope=\"col\" class=\"n\">95 %</th><th scope=\"col\" class=\"n\">maximum</th>"
      "<th scope=\"col\">unit</th><th scope=\"col\">against</th></tr></thead><tbody>";
  for (const ErrorRecord& e : report.errors) {
    out += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td><td class=\"soft\">{}</td></tr>",
        escape_html(e.name), show_number(e.value), optional_number(e.rms), optional_number(e.p95),
        optional_number(e.max), escape_html(e.unit), escape_html(e.reference));
  }
  out += "</tbody></table></div></section>\n";
}

void add_legend(std::string& out, std::span<const Curve> curves) {
  out += "<ul class=\"legend\">";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    out += fmt::format("<li>{}{}</li>", legend_svg(curves[i], i), escape_html(curves[i].name));
  }
  out += "</ul>";
}

void add_curve_table(std::string& out, std::span<const Curve> curves) {
  out += fmt::format(
      "<details><summary>The numbers</summary><div class=\"scroll\"><table><thead><tr>"
      "<th scope=\"col\">series</th><th scope=\"col\">point</th><th scope=\"col\" class=\"n\">{}</th>"
      "<th scope=\"col\" class=\"n\">{}</th></tr></thead><tbody>",
      escape_html(curves.front().x), escape_html(curves.front().y));
  for (const Curve& curve : curves) {
    for (const CurvePoint& p : curve.points) {
      out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
                         escape_html(curve.name), escape_html(p.label), show_number(p.x, 6),
                         show_number(p.y, 6));
    }
  }
  out += "</tbody></table></div></details>";
}

// Curves over the same two axes belong in one chart.
void add_curves(std::string& out, const Report& report) {
  std::vector<std::vector<Curve>> charts;
  for (const Curve& curve : report.curves) {
    const auto same = std::find_if(charts.begin(), charts.end(), [&](const std::vector<Curve>& c) {
      return c.front().x == curve.x && c.front().y == curve.y;
    });
    if (same == charts.end()) {
      charts.push_back({curve});
    } else {
      same->push_back(curve);
    }
  }
  if (charts.empty()) return;
  out += "<section><h2>Curves</h2>";
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const std::string svg = chart_svg(charts[i], fmt::format("chart{}", i + 1));
    out += fmt::format("<figure><figcaption><strong>{}</strong> against {}</figcaption>",
                       escape_html(charts[i].front().y), escape_html(charts[i].front().x));
    add_legend(out, charts[i]);
    out += svg.empty() ? "<p class=\"soft\">no point of these curves is finite</p>"
                       : fmt::format("<div class=\"plot\">{}</div>", svg);
    add_curve_table(out, charts[i]);
    out += "</figure>";
  }
  out += "</section>\n";
}

std::string as_heading(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return escape_html(text);
}

// Whether a cell reads as a number, so that its column is set flush right.
bool is_numeric(const std::string& cell) {
  double value = 0;
  const char* last = cell.data() + cell.size();
  const auto [end, error] = std::from_chars(cell.data(), last, value);
  return cell.empty() || (error == std::errc{} && last - end < 4);  // "12.5 %", "3 mm"
}

void add_tables(std::string& out, const Report& report) {
  for (const Table& table : report.tables) {
    std::vector<bool> numeric(table.columns.size(), !table.rows.empty());
    for (const auto& row : table.rows) {
      for (std::size_t c = 0; c < row.size() && c < numeric.size(); ++c) {
        numeric[c] = numeric[c] && is_numeric(row[c]);
      }
    }
    out +=
        fmt::format("<section><h2>{}</h2><div class=\"scroll\"><table><thead><tr>", as_heading(table.name));
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      out += fmt::format("<th scope=\"col\"{}>{}</th>", numeric[c] ? " class=\"n\"" : "",
                         escape_html(table.columns[c]));
    }
    out += "</tr></thead><tbody>";
    for (const auto& row : table.rows) {
      out += "<tr>";
      for (std::size_t c = 0; c < row.size(); ++c) {
        out += fmt::format("<td{}>{}</td>", c < numeric.size() && numeric[c] ? " class=\"n\"" : "",
                           escape_html(row[c]));
      }
      out += "</tr>";
    }
    out += "</tbody></table></div></section>\n";
  }
}

void add_pictures(std::string& out, const Report& report) {
  if (report.pictures.empty()) return;
  out += "<section><h2>Pictures</h2><div class=\"pictures\">";
  for (const ReportPicture& picture : report.pictures) {
    out += fmt::format(
        "<figure role=\"group\" "
        "aria-label=\"{}\">{}<figcaption><strong>{}</strong>{}{}</figcaption></figure>",
        escape_html(picture.title), picture.svg, escape_html(picture.title),
        picture.caption.empty() ? "" : "<br>", escape_html(picture.caption));
  }
  out += "</div></section>\n";
}

void add_file_rows(std::string& out, const char* role, const std::vector<FileRecord>& files) {
  for (const FileRecord& file : files) {
    out += fmt::format(
        "<tr><td class=\"soft\">{}</td><td><code>{}</code></td><td class=\"n\">{}</td>"
        "<td class=\"soft\"><code>{}</code></td></tr>",
        role, escape_html(file.path), show_count(file.bytes), escape_html(file.hash));
  }
}

void add_files(std::string& out, const Report& report) {
  if (report.inputs.empty() && report.outputs.empty()) return;
  out +=
      "<section><h2>Files</h2><div class=\"scroll\"><table><thead><tr><th scope=\"col\">role</th>"
      "<th scope=\"col\">path</th><th scope=\"col\" class=\"n\">bytes</th><th "
      "scope=\"col\">hash</th></tr></thead>"
      "<tbody>";
  add_file_rows(out, "read", report.inputs);
  add_file_rows(out, "written", report.outputs);
  out += "</tbody></table></div></section>\n";
}

void add_options(std::string& out, const Report& report) {
  if (report.options.empty()) return;
  out +=
      "<section><h2>Options</h2><div class=\"scroll\"><table><thead><tr><th scope=\"col\">option</th>"
      "<th scope=\"col\">value</th></tr></thead><tbody>";
  for (const auto& [name, value] : report.options) {
    out += fmt::format("<tr><th scope=\"row\"><code>{}</code></th><td><code>{}</code></td></tr>",
                       escape_html(name), escape_html(value));
  }
  out += "</tbody></table></div></section>\n";
}

}  // namespace

std::string to_html(const Report& report) {
  const std::string subject = names_of(report.inputs);
  const std::string tool = escape_html(report.tool);
  const std::string heading = subject.empty() ? tool : escape_html(subject);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<title>{}{}</title><style>{}</style></head>\n<body><header><p class=\"eyebrow\">{} {}</p><h1>{}</h1>",
      subject.empty() ? "" : escape_html(subject) + " · ", tool, k_page_style, tool,
      escape_html(report.version), heading);
  if (!report.outputs.empty())
    out += fmt::format("<p class=\"into\">made {}</p>", escape_html(names_of(report.outputs)));
  out += "</header>\n<main>";
  add_key_figures(out, report);
  add_warnings(out, report);
  add_stages(out, report);
  add_errors(out, report);
  add_curves(out, report);
  add_pictures(out, report);
  add_tables(out, report);
  add_options(out, report);
  add_files(out, report);
  out += fmt::format("</main>\n<footer>{} {} · copse.report/1</footer></body></html>\n", tool,
                     escape_html(report.version));
  return out;
}

}  // namespace copse
