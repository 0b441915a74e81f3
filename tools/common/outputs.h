// The outputs of one run: files become visible together, and only when the run has succeeded.
#pragma once

#include "lib/formats/container/atomic_file.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// "-" names stdout everywhere.
bool is_stdout(const std::filesystem::path& path);

// Everything, or the reason why not: a closed pipe is an error like any other.
Result<void> write_stdout(std::string_view bytes);

class Outputs {
 public:
  // Whether a file of this name could be written, as far as that can be known beforehand.
  static Result<void> check(const std::filesystem::path& path);

  Result<void> add(const std::filesystem::path& path, const Pieces& bytes);
  Result<void> commit();
  void discard();  // from any thread; waits until a file that is being written is whole

  const std::vector<FileRecord>& records() const { return records_; }  // without stdout

 private:
  std::mutex mutex_;
  OutputGroup group_;
  std::string stdout_;
  std::vector<FileRecord> records_;
};

}  // namespace copse
