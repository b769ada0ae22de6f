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
  float sigma_dps;      ///< 1-sigma uncertainty of zro_dps, worst axis
  std::uint16_t date;   ///< days since 1984-01-01 (CiA 301 TIME); 0 = unknown
  std::uint8_t weight;  ///< readings merged into it, saturating at 255
  Origin origin;
};

/// Offset at a temperature and how it was had.
struct Estimate {
  float zro_dps[kAxes];
  float sigma_dps;      ///< 1 sigma: noise_dps, and half of model_dps, in quadrature
  float distance_degc;  ///< to the nearest entry
  bool extrapolated;
  bool valid;         ///< false when the table is empty
  bool learned_only;  ///< no factory entry had a say
  float noise_dps;    ///< 1 sigma from the entries' own uncertainties
  float model_dps;    ///< bound on what the unknown shape between and beyond them may add
};

/// Sorted by temperature, fixed capacity, at most one learned and one factory entry a bin. Plain
/// value: copyable, no heap.
///
/// A factory entry is never displaced, so that it stays the reference of last resort; while a
/// learned entry lies within one bin width of it, it is shadowed: kept, but not looked up.
class Table {
 public:
  static constexpr int kCapacity = 48;
  static constexpr int kFactoryCapacity = 24;  ///< the other half is left to learning
  static constexpr std::uint16_t kLayoutVersion = 1;
  static constexpr std::size_t kEntryBytes = 24;
  static constexpr std::size_t kHeaderBytes = 16;
  static constexpr std::size_t kMaxImageBytes = kHeaderBytes + kCapacity * kEntryBytes;
  static constexpr float kFirstBinDegc = -40.0f;         ///< lower edge of bin 0
  static constexpr float kMaxExtrapolationDegc = 10.0f;  ///< beyond it the value is held

  explicit Table(float bin_degc = 2.5f) : bin_degc_(bin_degc) {}

  int size() const { return size_; }
  const Entry& operator[](int i) const { return entries_[i]; }
  float bin_degc() const { return bin_degc_; }

  /// Index of the bin a temperature falls into; negative below kFirstBinDegc.
  int BinOf(float temp_degc) const;
  /// Index of the nearest entry that is not shadowed, -1 when empty.
  int Nearest(float temp_degc) const;
  /// Index of the entry of that origin in the bin of `temp_degc`, -1 when there is none.
  int InBin(float temp_degc, Origin origin) const;
  /// True when entry `index` takes part in look-ups that leave out `without` (-1: none).
  bool IsActive(int index, int without = -1) const;

  /// Inserts in order; takes the place of the entry of the same bin and origin. When full, the
  /// oldest learned entry gives way. False when full of factory entries, or the entry is unfit.
  bool Insert(const Entry& entry);
  void Replace(int index, const Entry& entry);
  void Remove(int index);
  void Clear() { size_ = 0; }

  /// Inter- or extrapolation at `temp_degc` (fig. 5, 56), leaving out entry `without` (-1: none).
  /// Between entries: a line, or a parabola through a third entry where the gap is wide. Beyond
  /// the outermost: the same, for at most kMaxExtrapolationDegc, then held.
  Estimate At(float temp_degc, int without = -1) const;

  /// Canonical image: header {u16 layout_version, u16 entries, u32 generation, u8 origin, 7 x 0},
  /// then the entries. Returns its length. `generation` counts committed changes. Origin: 0 empty,
  /// 1 factory entries only, 2 with learned ones. `out` has room for kMaxImageBytes.
  std::size_t ToImage(std::uint32_t generation, std::uint8_t* out) const;
  /// False (and unchanged) when the image is not one `ToImage` of a table with these bins could
  /// have made.
  bool FromImage(const std::uint8_t* image, std::size_t size, std::uint32_t* generation);

 private:
  int Displaceable() const;
  /// The curve through the active entries, or the learned ones among them.
  Estimate Curve(float temp_degc, int without, bool factory) const;

  Entry entries_[kCapacity] = {};
  int size_ = 0;
  float bin_degc_;
};

/// True when an entry may stand in a table: finite, physical, known origin, weight at least 1.
bool IsFit(const Entry& entry);
/// Canonical order: by temperature; a factory entry before a learned one at the same temperature.
bool IsBefore(const Entry& a, const Entry& b);

}  // namespace zro
