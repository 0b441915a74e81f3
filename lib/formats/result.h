// How every fallible function of copse answers: a value, or one Error that a tool prints as one line.
#pragma once

#include <expected>
#include <string>
#include <utility>

namespace copse {

// What kind of thing went wrong. The value is the exit status of a tool.
enum class Fault {
  refused = 1,  // the input is bad or hostile; nothing was written
  usage = 2,    // the command line is wrong
  io = 3,       // a file could not be read or written
  limit = 4,    // done, but a limit that the user set is not met; nothing was written
  bug = 70,     // a defect of copse
};

struct Error {
  Fault fault = Fault::refused;
  std::string file;    // the file at fault; empty when none is
  std::string what;    // what is wrong, with the place: "line 12: face 3 names vertex 99 of 8"
  std::string remedy;  // what to do about it: "export the mesh again, or drop --strict to drop the face"
};

// "TOOL: error: FILE: what is wrong; what to do about it". Control characters are escaped: always one line.
std::string to_line(const Error& error, const std::string& tool);

template <class T>
using Result = std::expected<T, Error>;

inline std::unexpected<Error> fail(Fault fault, std::string file, std::string what, std::string remedy) {
  return std::unexpected(Error{fault, std::move(file), std::move(what), std::move(remedy)});
}
inline std::unexpected<Error> refuse(std::string file, std::string what, std::string remedy) {
  return fail(Fault::refused, std::move(file), std::move(what), std::move(remedy));
}

}  // namespace copse
