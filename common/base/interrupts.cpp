#include "common/base/interrupts.hpp"

#include <csignal>
#include <ctime>
#include <initializer_list>

namespace gyre {
namespace {

sigset_t blocked_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::sigaddset(&set, signal);
  return set;
}

}  // namespace

void block_interrupts() {
  const sigset_t set = blocked_signals();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

int take_interrupts() {
  const sigset_t set = blocked_signals();
  const timespec at_once{0, 0};
  int count = 0;
  for (int signal = 0; (signal = ::sigtimedwait(&set, nullptr, &at_once)) > 0;) {
    if (signal != SIGPIPE) ++count;
  }
  return count;
}

}  // namespace gyre
