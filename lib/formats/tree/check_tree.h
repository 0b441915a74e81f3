// Every invariant of a tree (digest 000 section 9); the parts of it that a loader needs; how findings are
// collected.
#pragma once

#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace copse {

// Every invariant of a tree in memory: all that fail, with the section and the element. Empty when it is
// sound.
std::vector<std::string> check_tree(const Tree& tree);

// One thing that is wrong, with the section and, if it is about one, the element.
struct Finding {
  std::string section;
  std::size_t element = static_cast<std::size_t>(-1);  // k_no_element: about none
  std::string what;
  static constexpr auto k_no_element = static_cast<std::size_t>(-1);
};

// "LGRP[12]: what", or "LGRP: what".
std::string to_text(const Finding& finding);

// Collects findings. Of each kind (section and kind of failure) the first k_listed are kept, the rest are
// counted: a file with a million bad indices gives a short list that still says a million, and in no time.
class Findings {
 public:
  static constexpr std::size_t k_listed = 8;

  // `kind` is the same for all failures of a kind: "vertex index out of range". `detail` is a text, or makes
  // one when it is called, which happens for what is listed only.
  template <class Detail = std::string>
  void add(std::string_view section, std::size_t element, std::string_view kind, Detail&& detail = {}) {
    if (!counted(section, kind)) return;
    if constexpr (std::is_invocable_v<Detail>) {
      list(section, element, kind, detail());
    } else {
      list(section, element, kind, detail);
    }
  }
  bool empty() const { return listed_.empty(); }
  const std::vector<Finding>& listed() const { return listed_; }
  // What is listed, then one line for each kind of which more were found: "LGRP: kind: 1000000 in all".
  std::vector<std::string> lines() const;

 private:
  struct Kind {
    std::string section, kind;
    std::size_t count = 0;
  };
  bool counted(std::string_view section, std::string_view kind);  // whether it is to be listed, too
  void list(std::string_view section, std::size_t element, std::string_view kind, const std::string& detail);
  std::vector<Finding> listed_;
  std::vector<Kind> kinds_;  // in the order of their first failure; there are never many
};

// Whether the arrays fit together: parallel arrays, offset tables, what a kind of tree may carry. All of it
// costs O(1).
std::vector<std::string> check_sizes(const Tree& tree);

// Whether the counts and constants of a header fit together: O(1), and enough to divide arrays by them. What
// is wrong, or nothing.
std::string check_counts(const Head& head);

// Every element of what is there. `head` says how many elements each array has in the file, loaded or not, so
// that a part of a tree can be checked. Precondition: the arrays that are there have these sizes.
void check_elements(const Tree& tree, const Head& head, Findings& findings);

inline constexpr std::size_t k_omitted_record = 16;  // a name, 4 zero bytes, the bytes saved
inline constexpr std::size_t k_omitted_bytes = 8;

}  // namespace copse
