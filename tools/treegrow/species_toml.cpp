#include "tools/treegrow/species_toml.h"

#include "tools/treegrow/species_data.h"
#include "tools/treegrow/species_fields.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace copse::grow {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// Without its comment; a # inside a string is none.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return line.substr(0, i);
  }
  return line;
}

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::string> word_in(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return std::nullopt;
  text = text.substr(1, text.size() - 2);
  if (text.find_first_of("\"\\") != std::string_view::npos) return std::nullopt;
  return std::string(text);
}

// Puts a value into a field; what is wrong with it, or nothing.
std::string assign(const Field& field, std::string_view text) {
  return std::visit(
      Overloaded{[&](const Number& n) -> std::string {
                   const auto value = number_in(text);
                   if (!value || *value < n.low || *value > n.high)
                     return fmt::format("is not a number from {} to {}", n.low, n.high);
                   *n.value = *value;
                   return {};
                 },
                 [&](const Colour& c) -> std::string {
                   const bool array = text.size() > 2 && text.front() == '[' && text.back() == ']';
                   std::string_view rest = array ? text.substr(1, text.size() - 2) : std::string_view{};
                   for (int i = 0; i < 3; ++i) {
                     const std::size_t comma = rest.find(',');
                     if ((comma == std::string_view::npos) != (i == 2)) return "is not [red, green, blue]";
                     const auto value = number_in(rest.substr(0, comma));
                     if (!value || *value < 0 || *value > 1) return "is not three numbers from 0 to 1";
                     (*c.value)[i] = static_cast<float>(*value);
                     rest.remove_prefix(i == 2 ? rest.size() : comma + 1);
                   }
                   return {};
                 },
                 [&](const Word& w) -> std::string {
                   const auto value = word_in(text);
                   if (!value) return "is not a \"string\" without quotes and backslashes inside";
                   *w.value = *value;
                   return {};
                 },
                 [&](const Choice& c) -> std::string {
                   const auto value = word_in(text);
                   for (std::size_t i = 0; value && i < c.names.size(); ++i)
                     if (*value == c.names[i]) return *c.value = static_cast<std::uint8_t>(i), std::string();
                   return fmt::format("is none of \"{}\"", fmt::join(c.names, "\", \""));
                 }},
      field.value);
}

std::string value_of(const Field& field) {
  return std::visit(Overloaded{[](const Number& n) { return fmt::format("{}", *n.value); },
                               [](const Colour& c) {
                                 return fmt::format("[{}, {}, {}]", c.value->x, c.value->y, c.value->z);
                               },
                               [](const Word& w) { return fmt::format("\"{}\"", *w.value); },
                               [](const Choice& c) { return fmt::format("\"{}\"", c.names[*c.value]); }},
                    field.value);
}

std::string meaning_of(const Field& field) {
  if (const auto* n = std::get_if<Number>(&field.value))
    return fmt::format("{} [{}, {}]", field.meaning, n->low, n->high);
  if (const auto* c = std::get_if<Choice>(&field.value))
    return fmt::format("{}: {}", field.meaning, fmt::join(c->names, ", "));
  return field.meaning;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    species_.levels.resize(std::size(k_level_tables));
    fields_ = fields_of(species_);
  }

  Result<Species> run() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = trimmed(without_comment(rest_.substr(0, end)));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
      if (line.empty()) continue;
      const std::string wrong = line.front() == '[' ? open_table(line) : take(line);
      if (!wrong.empty())
        return refuse(file_, fmt::format("line {}: {}", line_, wrong),
                      "treegrow --print oak shows every parameter");
    }
    const auto last = std::find(seen_, seen_ + 4, false) - seen_;
    if (last == 0 || std::find(seen_ + last, seen_ + 4, true) != seen_ + 4)
      return refuse(file_, "the levels are not level0 and those that follow it, without a gap",
                    "treegrow --print oak shows an example");
    species_.levels.resize(static_cast<std::size_t>(last));
    return species_;
  }

 private:
  std::string open_table(std::string_view line) {
    table_ = line.back() == ']' ? std::string(trimmed(line.substr(1, line.size() - 2))) : "";
    for (std::size_t l = 0; l < 4; ++l)
      if (table_ == k_level_tables[l]) return seen_[l] = true, std::string();
    if (table_ == "leaves" || table_ == "grass") return {};
    return fmt::format("there is no table {}", line);
  }

  std::string take(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return fmt::format("'{}' is not KEY = VALUE", line);
    const std::string_view key = trimmed(line.substr(0, equals)), value = trimmed(line.substr(equals + 1));
    if (table_.empty() && key == "base") return begin_with(value);
    for (const Field& field : fields_) {
      if (table_ != field.table || key != field.name) continue;
      const std::string wrong = assign(field, value);
      return wrong.empty() ? "" : fmt::format("{} = {} {}", key, value, wrong);
    }
    return fmt::format("there is no parameter '{}'{}", key, table_.empty() ? "" : " in [" + table_ + "]");
  }

  std::string begin_with(std::string_view value) {
    const auto name = word_in(value);
    const auto base = name ? find_species(*name) : std::nullopt;
    if (!base) return fmt::format("base = {} is no built-in species", value);
    species_ = *base;
    for (std::size_t l = 0; l < species_.levels.size(); ++l) seen_[l] = true;
    species_.levels.resize(std::size(k_level_tables));
    fields_ = fields_of(species_);
    return {};
  }

  std::string_view rest_;
  const std::string& file_;
  int line_ = 0;
  std::string table_;
  bool seen_[4] = {};
  Species species_;
  std::vector<Field> fields_;  // of species_
};

}  // namespace

std::string to_toml(const Species& species) {
  Species copy = species;
  std::string text;
  const char* table = "";
  for (const Field& field : fields_of(copy)) {
    if (std::string_view(field.table) != table) text += fmt::format("\n[{}]\n", table = field.table);
    const std::string setting = fmt::format("{} = {}", field.name, value_of(field));
    text += fmt::format("{:<32} # {}\n", setting, meaning_of(field));
  }
  return text;
}

Result<Species> species_from_toml(std::string_view text, const std::string& file) {
  return Reader(text, file).run();
}

const std::vector<std::string>& species_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const SpeciesText& text : species_texts()) result.emplace_back(text.name);
    return result;
  }();
  return names;
}

std::optional<Species> find_species(std::string_view name) {
  for (const SpeciesText& text : species_texts()) {
    if (text.name != name) continue;
    auto species = species_from_toml(text.toml, std::string(name) + ".toml");
    if (species) return std::move(*species);
  }
  return std::nullopt;
}

}  // namespace copse::grow
