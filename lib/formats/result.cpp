#include "lib/formats/result.h"

#include "lib/formats/printable.h"

namespace copse {

std::string to_line(const Error& error, const std::string& tool) {
  std::string line = tool + ": error: ";
  if (!error.file.empty()) line += error.file + ": ";
  line += error.what;
  if (!error.remedy.empty()) line += "; " + error.remedy;
  return printable(line);
}

}  // namespace copse
