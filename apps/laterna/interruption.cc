#include "interruption.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace laterna::app {
namespace {

using Handler = void (*)(int);
constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
constexpr int kShellsBase = 128;  // of a command's exit code, where a signal ended it

// A signal handler has nothing else to go by.
volatile std::sig_atomic_t noted = 0;              // NOLINT(*-global-variables)
std::array<Handler, kSignals.size()> before = {};  // NOLINT(*-global-variables)

extern "C" void note(int signal) {
  noted = signal;
  for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before[i]);
}

}  // namespace

Interruption::Interruption(bool is_wanted) : is_wanted_(is_wanted) {
  if (!is_wanted) return;
  noted = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    before[i] = std::signal(kSignals[i], SIG_IGN);
    // Whoever started us may want us to live on: nohup.
    std::signal(kSignals[i], before[i] == SIG_IGN ? SIG_IGN : note);
  }
}

Interruption::~Interruption() {
  if (!is_wanted_) return;
  for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before[i]);
}

int Interruption::signal() const { return is_wanted_ ? static_cast<int>(noted) : 0; }

void end_by_signal(int signal) {
  std::fflush(nullptr);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  std::_Exit(kShellsBase + signal);
}

}  // namespace laterna::app
