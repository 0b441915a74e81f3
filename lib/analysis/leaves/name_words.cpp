#include "lib/analysis/leaves/name_words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <unordered_map>

namespace copse {
namespace {

// Folded as words_of folds: no accents, lower case.
constexpr std::string_view k_trunk_words =
    "bark barks trunk trunks bole boles wood woody log logs timber roots stump stumps heartwood sapwood "
    "rinde borke stamm stamme staemme holz wurzel wurzeln "
    "ecorce tronc troncs bois racine racines "
    "corteza tronco troncos madera raiz raices "
    "casca madeira corteccia legno fusto radice radici "
    "schors stam stammen hout boomstam wortel wortels "
    "kora pien pnia drewno korzen korzenie kmen kura koren koreny "
    "stvol \u0441\u0442\u0432\u043e\u043b \u0441\u0442\u0432\u043e\u043b\u044b \u043a\u043e\u0440\u0430 "
    "\u0434\u0440\u0435\u0432\u0435\u0441\u0438\u043d\u0430 \u043a\u043e\u0440\u043d\u0438 "
    "runko kaarna juuri govde kabuk";
constexpr std::string_view k_weak_trunk_words =
    "branch branches root stem stems twig twigs limb limbs bough boughs stalk stalks stick sticks shoot "
    "shoots "
    "ast aste aeste zweig zweige stiel stiele "
    "branche rameau rameaux tige tiges rama ramas tallo tallos ramo ramos rami gambo "
    "galho galhos caule tak takken twijg gren grenar kvist kvistar "
    "galaz galezie vetev vetve oksa oksat "
    "vetka \u0432\u0435\u0442\u043a\u0430 \u0432\u0435\u0442\u043a\u0438 \u0432\u0435\u0442\u0432\u0438";
constexpr std::string_view k_leaf_words =
    "leaf leafs leaves leave leafy foliage needle needles frond fronds leaflet leaflets blossom blossoms "
    "petal petals flower flowers bloom blooms canopy "
    "blatt blatter blaetter laub nadel nadeln wedel blute bluten bluete blueten "
    "feuille feuilles feuillage aiguille aiguilles fleur fleurs petale petales "
    "hoja hojas follaje acicula aciculas flor flores petalo petalos "
    "folha folhas folhagem agulha agulhas petala petalas "
    "foglia foglie fogliame aghi fiore fiori petalo petali "
    "blad bladeren gebladerte naald naalden bloem bloemen lov barr blomma blommor "
    "lisc liscie listowie igla igly kwiat kwiaty listi listy jehlice kvet kvety "
    "listva \u043b\u0438\u0441\u0442 \u043b\u0438\u0441\u0442\u044c\u044f "
    "\u043b\u0438\u0441\u0442\u0432\u0430 "
    "\u0445\u0432\u043e\u044f \u0438\u0433\u043e\u043b\u043a\u0438 \u0446\u0432\u0435\u0442\u044b "
    "lehti lehdet lehvasto neulanen neulaset yaprak yapraklar cicek";
constexpr std::string_view k_weak_leaf_words =
    "crown crowns krone kronen cime copa fruit fruits berry berries bush shrub hedge cards card "
    "billboard billboards bud buds";
constexpr std::string_view k_grass_words =
    "grass grasses reed reeds straw gras graser graeser schilf halm halme herbe herbes roseau roseaux hierba "
    "hierbas pasto grama erba trawa trava trawy \u0442\u0440\u0430\u0432\u0430 ruoho heina";
// Scripts without spaces: found anywhere in a word.
constexpr std::string_view k_trunk_signs =
    "\u6811\u5e72 \u6a39\u5e79 \u6811\u76ae \u6a39\u76ae \u5e79 \u30df\u30ad \u307f\u304d \uc904\uae30 "
    "\uaecd\uc9c8";
constexpr std::string_view k_weak_trunk_signs = "\u679d \u6811\u679d \uac00\uc9c0";
constexpr std::string_view k_grass_signs = "\u8349";
constexpr std::string_view k_leaf_signs =
    "\u53f6 \u8449 \u82b1 \u306f\u3063\u3071 \u30cf\u30c3\u30d1 \uc78e \uaf43";
// What stands beside the words above in a compound and says nothing itself.
constexpr std::string_view k_neutral_words =
    "tree trees oak pine birch maple palm ash fir spruce willow elm beech poplar aspen cedar apple cherry "
    "plant "
    "cypress chestnut eucalyptus acacia baobab bamboo fern mat material tex texture mesh obj geo geometry "
    "lod "
    "part dead dry old new big small large main side top bottom inner outer high low poly autumn fall summer "
    "spring winter snow green brown red yellow orange white dark light single double two sided alpha atlas "
    "baum eiche eichen kiefer kiefern birke birken tanne tannen fichte fichten ahorn arbre chene arbol "
    "arvore "
    "albero boom drzewo strom derevo puu agac trad";

struct Entry {
  NameClass kind = NameClass::none;
  bool strong = false;
  bool neutral = false;
  bool grass = false;
};
using Dictionary = std::unordered_map<std::string_view, Entry>;

template <class Use>
void for_each_word(std::string_view list, Use&& use) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (end > 0) use(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
}

const Dictionary& dictionary() {
  static const Dictionary k_dictionary = [] {
    Dictionary words;
    const auto add = [&](std::string_view list, Entry entry) {
      for_each_word(list, [&](std::string_view word) { words.emplace(word, entry); });
    };
    add(k_trunk_words, {NameClass::trunk, true, false});
    add(k_weak_trunk_words, {NameClass::trunk, false, false});
    add(k_leaf_words, {NameClass::leaf, true, false});
    add(k_weak_leaf_words, {NameClass::leaf, false, false});
    add(k_grass_words, {NameClass::leaf, false, false, true});
    add(k_neutral_words, {NameClass::none, false, true});
    return words;
  }();
  return k_dictionary;
}

Entry look_up(std::string_view word) {
  const auto found = dictionary().find(word);
  return found == dictionary().end() ? Entry{} : found->second;
}

// --- characters ------------------------------------------------------------------------------------------

constexpr char32_t k_not_utf8 = 0xfffd;

char32_t decode(std::string_view& s) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  const unsigned lead = byte(0);
  const std::size_t n = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 1;
  char32_t c = n == 1 ? lead : lead & (0xff >> (n + 1));
  bool whole = n == 1 ? lead < 0x80 : n <= s.size();
  for (std::size_t i = 1; whole && i < n; ++i) {
    whole = (byte(i) & 0xc0) == 0x80;
    c = c << 6 | (byte(i) & 0x3f);
  }
  s.remove_prefix(whole ? n : 1);
  return whole ? c : k_not_utf8;
}

void encode(char32_t c, std::string& out) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xc0 | c >> 6);
    out += static_cast<char>(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xe0 | c >> 12);
    out += static_cast<char>(0x80 | (c >> 6 & 0x3f));
    out += static_cast<char>(0x80 | (c & 0x3f));
  } else {
    out += static_cast<char>(0xf0 | c >> 18);
    out += static_cast<char>(0x80 | (c >> 12 & 0x3f));
    out += static_cast<char>(0x80 | (c >> 6 & 0x3f));
    out += static_cast<char>(0x80 | (c & 0x3f));
  }
}

// Base letters of U+00C0 .. U+017F; '-' is no letter, '+' are two letters (below).
constexpr std::string_view k_latin =
    "aaaaaa+ceeeeiiiidnooooo-ouuuuyts"
    "aaaaaa+ceeeeiiiidnooooo-ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggg"
    "gggghhhhiiiiiiiiii++jjkkklllllll"
    "lllnnnnnnnnnoooooo++rrrrrrssssss"
    "ssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
static_assert(k_latin.size() == 0x180 - 0xc0);

bool is_upper(char32_t c) {
  if (c < 0x80) return c >= 'A' && c <= 'Z';
  if (c >= 0xc0 && c <= 0xde) return c != 0xd7;
  if (c >= 0x100 && c <= 0x17f) {  // capitals are even but for two runs
    const bool odd = (c >= 0x139 && c <= 0x148) || (c >= 0x179 && c <= 0x17e);
    return c % 2 == (odd ? 1 : 0);
  }
  return c >= 0x400 && c <= 0x42f;
}
bool is_letter(char32_t c) {
  if (c < 0x80) return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return c >= 0xc0 && c != 0xd7 && c != 0xf7 && c != k_not_utf8 && !(c >= 0x2000 && c <= 0x206f) &&
         !(c >= 0x3000 && c <= 0x303f);
}
void fold(char32_t c, std::string& out) {
  if (c < 0x80) {
    out += static_cast<char>(is_upper(c) ? c + 32 : c);
  } else if (c == 0xdf) {
    out += "ss";
  } else if (c >= 0xc0 && c < 0x180 && k_latin[c - 0xc0] != '+') {
    out += k_latin[c - 0xc0];
  } else if (c == 0xc6 || c == 0xe6) {
    out += "ae";
  } else if (c == 0x152 || c == 0x153) {
    out += "oe";
  } else if (c >= 0x410 && c <= 0x42f) {
    encode(c + 0x20, out);
  } else if (c == 0x401 || c == 0x451) {  // yo as ye
    encode(0x435, out);
  } else {
    encode(c, out);
  }
}

// --- verdicts --------------------------------------------------------------------------------------------

// A sign of a script that joins words: found anywhere.
bool find_sign(std::string_view list, std::string_view word, std::string& found) {
  for_each_word(list, [&](std::string_view sign) {
    if (found.empty() && word.find(sign) != std::string_view::npos) found = sign;
  });
  return !found.empty();
}

NameHint hint_of_signs(std::string_view word) {
  NameHint hint;
  if (find_sign(k_leaf_signs, word, hint.word)) {
    hint.kind = NameClass::leaf, hint.strong = true;
  } else if (find_sign(k_trunk_signs, word, hint.word)) {
    hint.kind = NameClass::trunk, hint.strong = true;
  } else if (find_sign(k_weak_trunk_signs, word, hint.word)) {
    hint.kind = NameClass::trunk;
  } else if (find_sign(k_grass_signs, word, hint.word)) {
    hint.kind = NameClass::leaf, hint.grass = true;
  }
  return hint;
}

// The word itself, or what is left of it without one neutral word in front and one behind.
NameHint hint_of_word(std::string_view word) {
  const Entry whole = look_up(word);
  if (whole.kind != NameClass::none) return {whole.kind, whole.strong, std::string(word), whole.grass};
  if (whole.neutral) return {};
  constexpr std::size_t k_shortest = 3, k_longest = 32;  // of a part of a compound, of a compound
  if (word.size() > k_longest) return {};
  for (std::size_t begin = 0; begin + k_shortest <= word.size(); ++begin) {
    if (begin > 0 && !look_up(word.substr(0, begin)).neutral) continue;
    for (std::size_t end = word.size(); end >= begin + k_shortest; --end) {
      if (end < word.size() && !look_up(word.substr(end)).neutral) continue;
      const std::string_view part = word.substr(begin, end - begin);
      const Entry entry = look_up(part);
      if (entry.kind != NameClass::none) return {entry.kind, entry.strong, std::string(part), entry.grass};
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> words_of(std::string_view name) {
  std::u32string text;
  while (!name.empty()) text += decode(name);
  std::vector<std::string> words;
  bool open = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char32_t c = text[i];
    if (!is_letter(c)) {
      open = false;
      continue;
    }
    const bool rises = i > 0 && is_upper(c) && !is_upper(text[i - 1]);
    const bool ends_capitals =
        i > 0 && is_upper(c) && i + 1 < text.size() && is_letter(text[i + 1]) && !is_upper(text[i + 1]);
    if (!open || rises || ends_capitals) words.emplace_back();
    open = true;
    fold(c, words.back());
  }
  return words;
}

NameHint name_hint(std::string_view name) {
  constexpr std::size_t k_longest_name = 256;  // what matters of a name is read; longer ones are no names
  std::array<NameHint, 2> best;                // trunk, leaf
  for (const std::string& word : words_of(name.substr(0, k_longest_name))) {
    NameHint hint = static_cast<unsigned char>(word[0]) >= 0x80 ? hint_of_signs(word) : NameHint{};
    if (hint.kind == NameClass::none) hint = hint_of_word(word);
    if (hint.kind == NameClass::none) continue;
    NameHint& of_kind = best[hint.kind == NameClass::leaf];
    if (of_kind.kind == NameClass::none || (hint.strong && !of_kind.strong)) of_kind = std::move(hint);
  }
  const auto& [trunk, leaf] = best;
  if (trunk.kind == NameClass::none) return leaf;
  if (leaf.kind == NameClass::none) return trunk;
  if (leaf.strong != trunk.strong) return leaf.strong ? leaf : trunk;
  return leaf.strong ? NameHint{} : leaf;
}

}  // namespace copse
