// How many threads a tool may use, as the machine, its cgroup and its batch system say.
#pragma once

#include <filesystem>
#include <string>

namespace copse {

inline constexpr int k_max_jobs = 4096;

// CPUs in the affinity mask of this process; at least 1.
int affinity_cpus();

// The smallest CPU quota of the process' cgroup and of those above it, in whole CPUs rounded up; v2
// (cpu.max) and v1 (cpu.cfs_quota_us / cpu.cfs_period_us). 0 when there is none. `root` is prepended to
// /proc/self/cgroup and /sys/fs/cgroup, for tests.
int cgroup_cpus(const std::filesystem::path& root = "/");

// A positive whole number as SLURM_CPUS_PER_TASK holds it; 0 when it is absent or anything else.
int slurm_cpus(const char* text);

// The smallest of the three that say anything, between 1 and k_max_jobs.
int default_jobs();

}  // namespace copse
