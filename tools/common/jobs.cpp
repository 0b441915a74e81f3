#include "tools/common/jobs.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <sched.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

constexpr int k_most_cpus = 1 << 20;  // beyond any mask that a kernel hands out

// The first line of a file, empty when there is none.
std::string first_line(const fs::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

int cpus_of(double quota, double period) {
  if (!(quota > 0) || !(period > 0)) return 0;
  return static_cast<int>(std::clamp(std::ceil(quota / period), 1.0, double{k_max_jobs}));
}

// "QUOTA PERIOD" or "max PERIOD".
int v2_quota(const fs::path& folder) {
  std::istringstream in(first_line(folder / "cpu.max"));
  double quota = 0, period = 0;
  return in >> quota >> period ? cpus_of(quota, period) : 0;
}

// A quota of -1 means none.
int v1_quota(const fs::path& folder) {
  std::istringstream quota_in(first_line(folder / "cpu.cfs_quota_us"));
  std::istringstream period_in(first_line(folder / "cpu.cfs_period_us"));
  double quota = 0, period = 0;
  return quota_in >> quota && period_in >> period ? cpus_of(quota, period) : 0;
}

int smaller(int a, int b) {
  if (a == 0 || b == 0) return a + b;
  return std::min(a, b);
}

// The smallest quota of `group` below `mount` and of every group above it. In a container the mount may
// already be the group itself, so that the path below it does not exist: the mount still counts.
int smallest_quota(const fs::path& mount, const std::string& group, int (*quota)(const fs::path&)) {
  int smallest = quota(mount);
  fs::path folder = mount;
  for (const fs::path& part : fs::path(group).relative_path()) {
    folder /= part;
    smallest = smaller(smallest, quota(folder));
  }
  return smallest;
}

bool names_controller(std::string_view list, std::string_view wanted) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    if (list.substr(0, end) == wanted) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

}  // namespace

int affinity_cpus() {
  for (int cpus = 1024; cpus <= k_most_cpus; cpus *= 2) {
    cpu_set_t* set = CPU_ALLOC(static_cast<std::size_t>(cpus));
    if (set == nullptr) break;
    const std::size_t size = CPU_ALLOC_SIZE(static_cast<std::size_t>(cpus));
    const bool known = ::sched_getaffinity(0, size, set) == 0;
    const int count = known ? CPU_COUNT_S(size, set) : 0;
    const bool too_small = !known && errno == EINVAL;
    CPU_FREE(set);
    if (known) return std::max(count, 1);
    if (!too_small) break;
  }
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int cgroup_cpus(const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  int smallest = 0;
  // hierarchy:controllers:path; version 2 has hierarchy 0 and no controllers.
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string group = line.substr(second + 1);
    if (controllers.empty()) {
      smallest = smaller(smallest, smallest_quota(mounts, group, v2_quota));
      smallest = smaller(smallest, smallest_quota(mounts / "unified", group, v2_quota));
    } else if (names_controller(controllers, "cpu")) {
      smallest = smaller(smallest, smallest_quota(mounts / "cpu", group, v1_quota));
      smallest = smaller(smallest, smallest_quota(mounts / controllers, group, v1_quota));
    }
  }
  return smallest;
}

int slurm_cpus(const char* text) {
  if (text == nullptr) return 0;
  const std::string_view view(text);
  int value = 0;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), value);
  return error == std::errc{} && end == view.data() + view.size() && value > 0 ? value : 0;
}

int default_jobs() {
  const int quota = smaller(cgroup_cpus(), slurm_cpus(std::getenv("SLURM_CPUS_PER_TASK")));
  return std::clamp(smaller(affinity_cpus(), quota), 1, k_max_jobs);
}

}  // namespace copse
