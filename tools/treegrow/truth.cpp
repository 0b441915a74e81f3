#include "tools/treegrow/truth.h"

#include <iterator>

#include <fmt/format.h>

namespace copse::grow {
namespace {

using Out = std::back_insert_iterator<std::string>;

void point(Out out, const Double3& p) {
  fmt::format_to(out, "[{:.15g},{:.15g},{:.15g}]", p.x, p.y, p.z);
}

std::int64_t index(std::uint32_t i) {
  return i == k_none ? -1 : static_cast<std::int64_t>(i);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

void head(Out out, const Truth& t) {
  fmt::format_to(out, "{{\"name\":{},\"mesh\":{},\"generator\":\"copse treegrow {}\",\"up_axis\":\"{}\",",
                 quoted(t.name), quoted(t.mesh), COPSE_VERSION, t.z_up ? 'z' : 'y');
  fmt::format_to(out, "\"height\":{:.15g},\"bbox\":[", t.height);
  point(out, t.bounds.min);
  *out++ = ',';
  point(out, t.bounds.max);
  fmt::format_to(out, "],\n");
}

void radii(Out out, const Truth& t) {
  fmt::format_to(out, "\"radii\":[");
  for (std::size_t i = 0; i < t.rings.size(); ++i) {
    const TruthRing& r = t.rings[i];
    fmt::format_to(out, "{}{{\"center\":", i == 0 ? "" : ",\n");
    point(out, r.centre);
    fmt::format_to(out, ",\"diameter\":{:.15g},\"parent\":{},\"branch\":{},\"tip\":{}", r.diameter,
                   index(r.parent), r.branch, r.tip ? 1 : 0);
    if (r.same_as != k_none) fmt::format_to(out, ",\"same_as\":{}", r.same_as);
    *out++ = '}';
  }
  fmt::format_to(out, "],\n");
}

void branches(Out out, const Truth& t) {
  fmt::format_to(out, "\"branches\":[");
  for (std::size_t i = 0; i < t.branches.size(); ++i) {
    const TruthBranch& b = t.branches[i];
    fmt::format_to(
        out,
        "{}{{\"id\":{},\"parent\":{},\"level\":{},\"first\":{},\"rings\":{},\"k\":{},\"terminal\":{},"
        "\"attach\":",
        i == 0 ? "" : ",\n", i, index(b.parent), b.level, b.first, b.rings, b.k, b.terminal);
    if (b.attach[0] == k_none) {
      fmt::format_to(out, "null}}");
    } else {
      fmt::format_to(out, "[{},{}]}}", b.attach[0], b.attach[1]);
    }
  }
  fmt::format_to(out, "],\n");
}

void leaves(Out out, const Truth& t) {
  fmt::format_to(out, "\"leaf_groups\":[");
  for (std::size_t i = 0; i < t.leaf_groups.size(); ++i) {
    const TruthLeafGroup& g = t.leaf_groups[i];
    fmt::format_to(out, "{}{{\"center\":", i == 0 ? "" : ",\n");
    point(out, g.centre);
    fmt::format_to(out, ",\"radius\":{:.15g},\"leaves\":{},\"branch\":{}}}", g.radius, g.leaves, g.branch);
  }
  fmt::format_to(out, "],\n\"leaves\":{{\"count\":{},\"components\":{},\"triangles\":{},\"centers\":[",
                 t.leaf_centres.size(), t.leaf_components, t.leaf_triangles);
  for (std::size_t i = 0; i < t.leaf_centres.size(); ++i) {
    if (i > 0) fmt::format_to(out, "{}", i % 4 == 0 ? ",\n" : ",");
    point(out, t.leaf_centres[i]);
  }
  fmt::format_to(out, "],\"branch\":[");
  for (std::size_t i = 0; i < t.leaf_branch.size(); ++i)
    fmt::format_to(out, "{}{}", i == 0 ? "" : ",", t.leaf_branch[i]);
  fmt::format_to(out, "]}},\n");
}

}  // namespace

std::string to_json(const Truth& truth) {
  std::string json;
  const Out out(json);
  head(out, truth);
  radii(out, truth);
  branches(out, truth);
  leaves(out, truth);
  fmt::format_to(out, "\"extra\":{{");
  for (std::size_t i = 0; i < truth.made.size(); ++i)
    fmt::format_to(out, "{}{}:{}", i == 0 ? "" : ",", quoted(truth.made[i].first),
                   quoted(truth.made[i].second));
  fmt::format_to(out, "}}}}\n");
  return json;
}

}  // namespace copse::grow
