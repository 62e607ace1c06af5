#include "base/output_file_registry.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>

#include "laterna/output.h"

namespace laterna {
namespace {

enum class SlotState : int {
  free,      // anyone may claim it
  claimed,   // its owner writes the path
  pending,   // the path names a temporary file
  removing,  // a signal handler reads the path; the process is ending, and the slot is used no more
};

}  // namespace

// Slots are never freed, so that a handler may walk the list at any time: there are as many as files were
// ever written at once.
struct PendingOutput::Slot {
  std::atomic<SlotState> state = SlotState::claimed;
  Slot* next = nullptr;
  std::array<char, PATH_MAX> path = {};

  // A signal handler has nothing else to go by.
  static std::atomic<Slot*> first;  // NOLINT(*-global-variables)
};

// NOLINTNEXTLINE(*-global-variables)
constinit std::atomic<PendingOutput::Slot*> PendingOutput::Slot::first = nullptr;

static_assert(std::atomic<SlotState>::is_always_lock_free && std::atomic<void*>::is_always_lock_free,
              "a signal handler may touch only atomics without locks");

PendingOutput::Slot* PendingOutput::claim_slot() {
  for (Slot* slot = Slot::first.load(); slot != nullptr; slot = slot->next) {
    SlotState expected = SlotState::free;
    if (slot->state.compare_exchange_strong(expected, SlotState::claimed)) return slot;
  }
  Slot* const slot = new Slot;
  slot->next = Slot::first.load();
  while (!Slot::first.compare_exchange_weak(slot->next, slot)) {
  }
  return slot;
}

PendingOutput::PendingOutput(const std::string& path) {
  if (path.size() >= PATH_MAX) return;
  slot_ = claim_slot();
  std::memcpy(slot_->path.data(), path.c_str(), path.size() + 1);
  slot_->state.store(SlotState::pending);
}

PendingOutput::~PendingOutput() {
  if (slot_ == nullptr) return;
  ::unlink(slot_->path.data());
  release();
}

const char* PendingOutput::path() const { return slot_->path.data(); }

void PendingOutput::release() {
  SlotState expected = SlotState::pending;
  slot_->state.compare_exchange_strong(expected, SlotState::free);
  slot_ = nullptr;
}

void remove_pending_outputs() noexcept {
  const int number = errno;
  for (PendingOutput::Slot* slot = PendingOutput::Slot::first.load(); slot != nullptr; slot = slot->next) {
    SlotState expected = SlotState::pending;
    if (slot->state.compare_exchange_strong(expected, SlotState::removing)) ::unlink(slot->path.data());
  }
  errno = number;
}

}  // namespace laterna
