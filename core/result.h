#pragma once
// How the host code reports what the world did to it. The freestanding corrector has its own codes.
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace zrobench {

/// Why an operation could not be done. The kind decides blame and exit code; the message is for
/// people (where it happened, what to do about it) and is never parsed.
struct Error {
  enum class Kind {
    kTimeout,   ///< the peer stayed silent; its state is unknown
    kProtocol,  ///< the peer spoke, but not what the protocol allows
    kRefused,   ///< the peer understood and said no (Modbus exception, SDO abort)
    kLimit,     ///< we refused: the value lies outside the station's limits
    kClosed,    ///< port, file or bus is gone
    kConfig,    ///< profile, station, map or data file is wrong; message carries file:line:column
    kFile,      ///< a file could not be read or written
    kTime,      ///< a clock went backwards: nothing measured around it can be dated
    kInternal,  ///< a bug here
  };
  Kind kind = Kind::kInternal;
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

[[nodiscard]] inline tl::unexpected<Error> Fail(Error::Kind kind, std::string message) {
  return tl::unexpected<Error>(Error{kind, std::move(message)});
}

}  // namespace zrobench
