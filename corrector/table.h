#pragma once
// The lookup table of (temperature, ZRO) pairs (US 8,577,633 B2, claim 1) and its canonical image.
#include <cstddef>
#include <cstdint>

#include "corrector/types.h"

namespace zro {

enum class Origin : std::uint8_t { kFactory = 1, kLearned = 2 };

/// One pair. In the image: 24 bytes, little endian, in this order, no padding.
struct Entry {
  float temp_degc;
  float zro_dps[kAxes];
  float sigma_dps;        ///< 1-sigma uncertainty of zro_dps, worst axis
  std::uint16_t date;     ///< days since 1984-01-01 (CiA 301 TIME); 0 = unknown
  std::uint8_t weight;    ///< readings merged into it, saturating at 255
  Origin origin;
};

/// Offset at a temperature and how it was had.
struct Estimate {
  float zro_dps[kAxes];
  float sigma_dps;
  float distance_degc;    ///< to the nearest entry
  bool extrapolated;
  bool valid;             ///< false when the table is empty
};

/// Sorted by temperature, at most one entry a bin, fixed capacity. Plain value: copyable, no heap.
class Table {
 public:
  static constexpr int kCapacity = 48;
  static constexpr std::uint16_t kLayoutVersion = 1;
  static constexpr std::size_t kEntryBytes = 24;
  static constexpr std::size_t kHeaderBytes = 16;
  static constexpr std::size_t kMaxImageBytes = kHeaderBytes + kCapacity * kEntryBytes;

  int size() const { return size_; }
  const Entry& operator[](int i) const { return entries_[i]; }

  /// Index of the entry nearest to `temp_degc`, -1 when empty.
  int Nearest(float temp_degc) const;
  /// Inserts in order. False when full and nothing may be displaced.
  bool Insert(const Entry& entry);
  void Replace(int index, const Entry& entry);
  void Remove(int index);
  void Clear() { size_ = 0; }

  /// Inter- or extrapolation at `temp_degc` (fig. 5, 56), leaving out entry `without` (-1: none).
  /// Beyond the outermost entries the slope of the outermost pair is used for a bounded distance.
  Estimate At(float temp_degc, int without = -1) const;

  /// Canonical image: header {u16 layout_version, u16 entries, u32 generation, u8 origin, 7 x 0},
  /// then the entries. Returns its length. `generation` counts committed changes.
  std::size_t ToImage(std::uint32_t generation, std::uint8_t* out) const;
  /// False (and unchanged) when the image is not one `ToImage` could have made.
  bool FromImage(const std::uint8_t* image, std::size_t size, std::uint32_t* generation);

 private:
  Entry entries_[kCapacity] = {};
  int size_ = 0;
};

}  // namespace zro
