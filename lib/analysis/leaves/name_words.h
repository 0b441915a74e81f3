// name_words: what the name of a material, group or object says about its triangles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

enum class NameClass : std::uint8_t { none, trunk, leaf };

struct NameHint {
  NameClass kind = NameClass::none;
  // Strong words name the thing itself ("bark", "needles"). Weak ones are given to either ("branch" is wood
  // or a card with a branch painted on it; "crown", "grass"): shape may overrule them.
  bool strong = false;
  std::string word;  // as listed, lower case, without accents
  bool grass =
      false;  // a weak word for what is all leaf, yet moves from its root like a trunk: "grass", "reed"
};

// A name's words: split where letters meet anything else, at aB and at ABc; lower case, Latin letters without
// their accents, Cyrillic in lower case; digits are dropped. "Bark_NormalTree.001" -> bark normal tree.
std::vector<std::string> words_of(std::string_view name);

// English, Chinese, Czech, Dutch, Finnish, French, German, Italian, Japanese, Korean, Polish, Portuguese,
// Russian, Spanish, Swedish, Turkish; whole words, or compounds with neutral ones ("oakbark", "treeleaves").
// A leaf word beats a weak trunk word ("leaf_branch"); words of both kinds that are strong say nothing.
NameHint name_hint(std::string_view name);

}  // namespace copse
