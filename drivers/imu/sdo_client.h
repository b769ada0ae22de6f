#pragma once
// SDO client of CiA 301 (7.2.4.3): expedited and segmented transfers with one server.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "corrector/node/sdo.h"
#include "drivers/link/can_bus.h"

namespace zrobench {

/// What an abort code means (CiA 301, table 22), in words.
const char* SdoAbortText(std::uint32_t code);

/// One transfer at a time. Calls block in Clock::Wait until done or until the deadline. Errors:
/// kRefused when the server aborts (message: its code in words), kTimeout when it stays silent and
/// kProtocol when it answers what the protocol does not allow (either is told to the server by an
/// abort, so that the next transfer starts clean), else what sending or pumping failed with.
class SdoClient {
 public:
  /// Takes every frame waiting on the bus and offers each to OnFrame(). Never blocks.
  using Pump = std::function<Status()>;

  /// Bus and clock are borrowed.
  SdoClient(CanBus& bus, Clock& clock, Pump pump)
      : bus_(bus), clock_(clock), pump_(std::move(pump)) {}
  SdoClient(const SdoClient&) = delete;
  SdoClient& operator=(const SdoClient&) = delete;

  void OnFrame(const zro::node::Frame& frame);

  Result<std::vector<std::uint8_t>> Upload(std::uint16_t index, std::uint8_t sub, Instant deadline);
  Status Download(std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes,
                  Instant deadline);

 private:
  /// The object of the transfer under way; every message about it names it.
  struct Transfer {
    std::uint16_t index = 0;
    std::uint8_t sub = 0;
    const char* verb = "";
    Instant deadline{};
  };
  using Frame = zro::node::Frame;

  Frame Request(std::uint8_t command, std::uint32_t data) const;
  Result<Frame> Exchange(const Frame& request);
  bool Answers(const Frame& request, const Frame& reply) const;
  Result<std::vector<std::uint8_t>> UploadSegments(std::uint32_t size);
  Status DownloadSegments(std::span<const std::uint8_t> bytes);
  tl::unexpected<Error> Abort(zro::node::SdoAbort code, Error::Kind kind, std::string why);
  tl::unexpected<Error> Unexpected(const Frame& reply);
  std::string Name() const;

  CanBus& bus_;
  Clock& clock_;
  Pump pump_;
  Transfer transfer_;
  std::optional<Frame> reply_;
};

}  // namespace zrobench
