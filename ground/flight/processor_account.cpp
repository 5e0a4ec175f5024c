#include "ground/flight/processor_account.hpp"

#include <sched.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <limits>
#include <string>

namespace gyre::ground {
namespace {

std::string place(pid_t pid) {
  return "/proc/" + std::to_string(pid) + "/";
}

ProcessorAccount::Process process_account(pid_t pid) {
  ProcessorAccount::Process process;
  clockid_t clock{};
  timespec used{};
  if (::clock_getcpuclockid(pid, &clock) == 0 && ::clock_gettime(clock, &used) == 0) {
    process.used = std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
  }
  std::ifstream file(place(pid) + "schedstat");
  std::int64_t ran_ns = 0;
  std::int64_t waited_ns = 0;
  if (file >> ran_ns >> waited_ns) process.waited = Duration(waited_ns);
  return process;
}

/// Children that the main thread has started; no thread of ours starts any but that one.
void add_with_children(pid_t pid, ProcessorAccount& account) {
  account.processes[pid] = process_account(pid);
  std::ifstream children(place(pid) + "task/" + std::to_string(pid) + "/children");
  for (pid_t child = 0; children >> child;) add_with_children(child, account);
}

std::vector<Duration> stolen() {
  const auto ticks_per_s = static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::vector<Duration> of_each;
  std::ifstream file("/proc/stat");
  std::string name;
  while (file >> name && name.rfind("cpu", 0) == 0) {
    double ticks = 0.0;
    for (int figure = 1; figure <= 8; ++figure) file >> ticks;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (name != "cpu") of_each.push_back(from_seconds(ticks / ticks_per_s));  // that line is the sum
  }
  return of_each;
}

}  // namespace

ProcessorAccount processor_account() {
  ProcessorAccount account;
  add_with_children(::getpid(), account);
  account.stolen = stolen();
  cpu_set_t ours;
  if (::sched_getaffinity(0, sizeof ours, &ours) == 0) account.processors = CPU_COUNT(&ours);
  return account;
}

}  // namespace gyre::ground
