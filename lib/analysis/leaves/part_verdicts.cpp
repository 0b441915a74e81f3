#include "lib/analysis/leaves/part_verdicts.h"

#include "lib/analysis/leaves/glob.h"

#include <algorithm>
#include <array>
#include <set>

namespace copse {
namespace {

// The names of a part, the most telling first.
struct NameOf {
  const char* what;
  const std::string& name;
};
std::array<NameOf, 3> names_of(const Mesh& mesh, const Part& part) {
  static const std::string k_no_name;
  const std::string& material =
      part.material < mesh.materials.size() ? mesh.materials[part.material].name : k_no_name;
  return {NameOf{"material", material}, NameOf{"group", part.group}, NameOf{"object", part.object}};
}

std::string known_names(const Mesh& mesh) {
  std::set<std::string> names;
  for (const Part& part : mesh.parts) {
    for (const auto& [what, name] : names_of(mesh, part)) {
      if (!name.empty()) names.insert(name);
    }
  }
  if (names.empty()) return "the mesh has no names: leave the pattern out, it decides by shape then";
  constexpr std::size_t k_listed = 12;  // an error is one line
  std::string list = "its names are ";
  std::size_t n = 0;
  for (const std::string& name : names) {
    if (n == k_listed) {
      list += " and " + std::to_string(names.size() - k_listed) + " more";
      break;
    }
    list += (n++ ? ", '" : "'") + name + "'";
  }
  return list;
}

// Which patterns of one list claim which part.
class Patterns {
 public:
  Patterns(const Mesh& mesh, const char* option, const std::vector<std::string>& patterns)
      : option_(option), claims_(mesh.parts.size()) {
    for (const std::string& pattern : patterns) {
      bool used = false;
      for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        for (const auto& [what, name] : names_of(mesh, mesh.parts[p])) {
          // "*" also takes what has no name; nothing at all names nothing.
          if (pattern.empty() || !glob_match(pattern, name)) continue;
          used = true;
          if (claims_[p].empty()) {
            claims_[p] = option_ + (" '" + pattern + "' matches ") + (name.empty() ? "a " : "") + what;
            claims_[p] += name.empty() ? std::string(" without a name") : " '" + name + "'";
          }
          break;
        }
      }
      if (!used && unused_.empty()) unused_ = option_ + (" '" + pattern + "'");
    }
  }
  const std::string& unused() const { return unused_; }  // the first pattern that matches nothing
  const std::string& claim(std::size_t part) const { return claims_[part]; }  // empty: none

 private:
  std::string option_;
  std::vector<std::string> claims_;
  std::string unused_;
};

PartVerdict named(const Mesh& mesh, const Part& part) {
  for (const auto& [what, name] : names_of(mesh, part)) {
    const NameHint hint = name_hint(name);
    if (hint.kind == NameClass::none) continue;
    std::string reason = std::string(what) + " '" + name + "' says " + hint.word;
    return {hint.kind, hint.strong ? Binding::firm : Binding::weak, reason, hint.grass ? reason : ""};
  }
  return {};
}

// Names that the whole mesh bears do not tell its parts apart: words for trunk or leaf may still be overruled
// by shape then, and words that are given to either say nothing.
void loosen_what_all_bear(std::vector<PartVerdict>& verdicts, const std::vector<bool>& used) {
  bool trunk = false, leaf = false, nothing = false, firm = false;
  for (std::size_t p = 0; p < verdicts.size(); ++p) {
    if (!used[p]) continue;
    trunk |= verdicts[p].kind == NameClass::trunk;
    leaf |= verdicts[p].kind == NameClass::leaf;
    nothing |= verdicts[p].kind == NameClass::none;
    firm |= verdicts[p].binding == Binding::firm;
  }
  if (trunk + leaf + nothing > 1) return;
  for (PartVerdict& verdict : verdicts) {
    if (!firm) verdict = {NameClass::none, Binding::none, "", std::move(verdict.grass)};
    if (verdict.binding == Binding::firm) verdict.binding = Binding::whole;
  }
}

}  // namespace

Result<std::vector<PartVerdict>> part_verdicts(const Mesh& mesh, const ClassifyOptions& options) {
  const Patterns trunk(mesh, "--trunk", options.trunk_patterns), leaf(mesh, "--leaf", options.leaf_patterns);
  for (const Patterns* patterns : {&trunk, &leaf}) {
    if (patterns->unused().empty()) continue;
    return fail(Fault::usage, "", patterns->unused() + " matches no material, group or object",
                known_names(mesh));
  }
  std::vector<PartVerdict> verdicts(mesh.parts.size());
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    if (trunk.claim(p).empty() && leaf.claim(p).empty()) verdicts[p] = named(mesh, mesh.parts[p]);
  }
  std::vector<bool> used(mesh.parts.size(), false);
  for (const std::uint32_t part : mesh.part_of) used[part] = true;
  loosen_what_all_bear(verdicts, used);
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const std::string &as_trunk = trunk.claim(p), &as_leaf = leaf.claim(p);
    if (!as_trunk.empty() && !as_leaf.empty()) {
      return fail(Fault::usage, "", as_trunk + " and " + as_leaf, "make the patterns exclude each other");
    }
    if (!as_trunk.empty()) verdicts[p] = {NameClass::trunk, Binding::firm, as_trunk, ""};
    if (!as_leaf.empty()) verdicts[p] = {NameClass::leaf, Binding::firm, as_leaf, ""};
  }
  return verdicts;
}

bool loosen_leaf_names(std::vector<PartVerdict>& verdicts) {
  bool any = false;
  for (PartVerdict& v : verdicts) {
    if (v.kind == NameClass::trunk) return false;
    any |= v.kind == NameClass::leaf && v.binding == Binding::firm;
  }
  if (!any) return false;
  for (PartVerdict& v : verdicts) {
    if (v.kind == NameClass::leaf && v.binding == Binding::firm) v.binding = Binding::whole;
  }
  return true;
}

}  // namespace copse
