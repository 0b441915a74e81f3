// JSON text, written as it is found: the bulk data of a tree would not fit a document in memory twice.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// Objects and lists go on lines of their own unless they are opened `inline`. Numbers round-trip; what is not
// finite becomes null. Commas are its own business.
class JsonText {
 public:
  enum Layout { lines, in_line };

  void open_object(Layout layout = lines) { open('{', layout); }
  void open_list(Layout layout = lines) { open('[', layout); }
  void close();
  void key(std::string_view name);

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(const std::string& text) { value(std::string_view(text)); }
  void value(bool truth) { raw(truth ? "true" : "false"); }
  void value(std::uint32_t number);
  void value(std::uint64_t number);
  void value(std::int64_t number);
  void value(float number);
  void value(double number);
  void null() { raw("null"); }
  template <class T>
  void value(const Vec2<T>& v) {
    open_list(in_line), value(v.x), value(v.y), close();
  }
  template <class T>
  void value(const Vec3<T>& v) {
    open_list(in_line), value(v.x), value(v.y), value(v.z), close();
  }
  // An empty box is null.
  void value(const FloatBox& box) {
    if (box.empty()) return null();
    open_object(in_line), member("min", box.min), member("max", box.max), close();
  }
  template <std::size_t N>
  void value(const std::array<std::uint32_t, N>& v) {
    open_list(in_line);
    for (const std::uint32_t i : v) value(i);
    close();
  }
  template <class T>
  void member(std::string_view name, const T& v) {
    key(name);
    value(v);
  }

  // Text that is JSON already.
  void raw(std::string_view text);
  std::string take();  // closes with a line break

 private:
  struct Level {
    char closing;
    Layout layout;
    bool empty = true;
  };
  void open(char bracket, Layout layout);
  void separate();
  void new_line();

  std::string out_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace copse
