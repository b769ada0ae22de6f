#pragma once
// How a run may end early. Not an Error: nothing is wrong with the program or the input.
#include <atomic>
#include <string>
#include <tl/expected.hpp>

namespace zrobench {

struct Halt {
  enum class Why {
    kInterrupted,  ///< a person asked (SIGINT, SIGTERM)
    kRigFault,     ///< an instrument or its link failed
    kSafetyTrip,   ///< a limit was passed: the bench was made safe on purpose
    kUnfit,        ///< the board lacks what the profile asks of it: nothing has moved
    kInternal,     ///< a bug of this program: an exception came out of the sequence
  };
  Why why = Why::kRigFault;
  std::string text;
};

/// What a part of a run returns: went through, or halted.
using Flow = tl::expected<void, Halt>;
inline tl::unexpected<Halt> Stop(Halt::Why why, std::string text) {
  return tl::unexpected<Halt>(Halt{why, std::move(text)});
}

/// Asked from a signal handler. 1 = at the next safe point: no stimulus plays and the board has its
/// supply. 2 = now.
struct StopRequest {
  std::atomic<int> level{0};
  std::atomic<int> signal{0};
};

}  // namespace zrobench
