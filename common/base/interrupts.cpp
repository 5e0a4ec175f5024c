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

Interrupts take_interrupts() {
  const sigset_t set = blocked_signals();
  const timespec at_once{0, 0};
  Interrupts taken;
  for (int signal = 0; (signal = ::sigtimedwait(&set, nullptr, &at_once)) > 0;) {
    if (signal == SIGTERM) ++taken.by_system;
    if (signal == SIGINT || signal == SIGHUP) ++taken.by_person;
  }
  return taken;
}

}  // namespace gyre
