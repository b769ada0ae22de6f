#pragma once
// The one table of how items lie in a record: message names, fields in file order, their units.
// Writer, reader and format texts are all made from it.
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "corrector/table.h"
#include "rig/record/item.h"

namespace zrobench {

/// Field `name` of an item, in `unit` (units "1" and "" are not written to the file).
template <typename Item, typename T>
struct ItemField {
  T Item::*member;
  const char* name;
  const char* unit;
};
template <typename Item, typename T>
ItemField(T Item::*, const char*, const char*) -> ItemField<Item, T>;

template <typename Item>
struct ItemLayout;

template <>
struct ItemLayout<ImuSample> {
  static constexpr const char* kName = "imu_sample";
  static constexpr std::tuple kFields = {
      ItemField{&ImuSample::at_us, "timestamp", "us"},
      ItemField{&ImuSample::raw, "raw_lsb", "125*2^(raw_flags&15)/32768 dps"},
      ItemField{&ImuSample::accel, "accel_lsb", "0.000125 g"},
      ItemField{&ImuSample::rate, "rate_lsb", "1/256 dps"},
      ItemField{&ImuSample::seq, "seq", "1"},
      ItemField{&ImuSample::raw_flags, "raw_flags", "1"},
      ItemField{&ImuSample::accel_flags, "accel_flags", "1"},
      ItemField{&ImuSample::rate_flags, "rate_flags", "1"}};
};
template <>
struct ItemLayout<ImuTime> {
  static constexpr const char* kName = "imu_time";
  static constexpr std::tuple kFields = {
      ItemField{&ImuTime::at_us, "timestamp", "us"},
      ItemField{&ImuTime::device_us, "device_us", "us"},
      ItemField{&ImuTime::counter, "counter", "1"},
      ItemField{&ImuTime::temperature, "temperature_lsb", "1/256 degC"}};
};
template <>
struct ItemLayout<ImuCorrection> {
  static constexpr const char* kName = "imu_correction";
  static constexpr std::tuple kFields = {ItemField{&ImuCorrection::at_us, "timestamp", "us"},
                                         ItemField{&ImuCorrection::zro, "zro_lsb", "1/1024 dps"},
                                         ItemField{&ImuCorrection::bin, "bin", "1"},
                                         ItemField{&ImuCorrection::state, "state", "1"},
                                         ItemField{&ImuCorrection::age, "age", "1"}};
};
template <>
struct ItemLayout<BusFrame> {
  static constexpr const char* kName = "bus_frame";
  static constexpr std::tuple kFields = {
      ItemField{&BusFrame::at_us, "timestamp", "us"}, ItemField{&BusFrame::id, "id", "1"},
      ItemField{&BusFrame::dlc, "dlc", "1"}, ItemField{&BusFrame::own, "own", "1"},
      ItemField{&BusFrame::data, "data", "1"}};
};
template <>
struct ItemLayout<PlateItem> {
  static constexpr const char* kName = "plate";
  static constexpr std::tuple kFields = {
      ItemField{&PlateItem::at_us, "timestamp", "us"},
      ItemField{&PlateItem::setpoint_degc, "setpoint_degc", "degC"},
      ItemField{&PlateItem::process_degc, "plate_degc", "degC"},
      ItemField{&PlateItem::drive_pct, "drive_pct", "%"},
      ItemField{&PlateItem::ambient_degc, "ambient_degc", "degC"}};
};
template <>
struct ItemLayout<SpeakerItem> {
  static constexpr const char* kName = "speaker";
  static constexpr std::tuple kFields = {ItemField{&SpeakerItem::at_us, "timestamp", "us"},
                                         ItemField{&SpeakerItem::hz, "tone_hz", "Hz"},
                                         ItemField{&SpeakerItem::v, "tone_v", "V rms"},
                                         ItemField{&SpeakerItem::spl_db, "tone_spl_db", "dB SPL"},
                                         ItemField{&SpeakerItem::band_hz, "tone_band_hz", "Hz"}};
};
template <>
struct ItemLayout<MeanItem> {
  static constexpr const char* kName = "mean_1s";
  static constexpr std::tuple kFields = {ItemField{&MeanItem::at_us, "timestamp", "us"},
                                         ItemField{&MeanItem::imu_degc, "imu_degc", "degC"},
                                         ItemField{&MeanItem::raw_dps, "raw_dps", "deg/s"},
                                         ItemField{&MeanItem::rate_dps, "rate_dps", "deg/s"},
                                         ItemField{&MeanItem::accel_g, "accel_g", "g"},
                                         ItemField{&MeanItem::samples, "samples", "1"}};
};
template <>
struct ItemLayout<TableItem> {
  static constexpr const char* kName = "corrector_table";
  static constexpr std::tuple kFields = {
      ItemField{&TableItem::at_us, "timestamp", "us"}, ItemField{&TableItem::crc32, "crc32", "1"},
      ItemField{&TableItem::image, "image", "1"}, ItemField{&TableItem::when, "when", "1"}};
};
template <>
struct ItemLayout<LogItem> {
  static constexpr const char* kName = "decision_log";
  static constexpr std::tuple kFields = {ItemField{&LogItem::at_us, "timestamp", "us"},
                                         ItemField{&LogItem::bytes, "bytes", "1"}};
};
template <>
struct ItemLayout<EventItem> {
  static constexpr const char* kName = "event";
  static constexpr std::tuple kFields = {ItemField{&EventItem::at_us, "timestamp", "us"},
                                         ItemField{&EventItem::a, "a", "1"},
                                         ItemField{&EventItem::b, "b", "1"},
                                         ItemField{&EventItem::step, "step", "1"},
                                         ItemField{&EventItem::kind, "kind", "1"},
                                         ItemField{&EventItem::text, "text", ""}};
};

/// The items that are ULog data messages, in the order of their message ids.
using DataItems = std::tuple<ImuSample, ImuTime, ImuCorrection, BusFrame, PlateItem, SpeakerItem,
                             MeanItem, TableItem, LogItem, EventItem>;

template <typename T, std::size_t I = 0>
constexpr std::uint16_t DataItemId() {
  static_assert(I < std::tuple_size_v<DataItems>, "no data item");
  if constexpr (std::is_same_v<T, std::tuple_element_t<I, DataItems>>) {
    return I;
  } else {
    return DataItemId<T, I + 1>();
  }
}

/// How one member type is packed. ULog has fixed sizes only: texts and images are padded with 0.
template <typename T>
struct FieldCodec {
  static constexpr std::size_t kBytes = sizeof(T);
  static void Pack(const T& value, std::uint8_t* to) { std::memcpy(to, &value, kBytes); }
  static void Unpack(T& value, const std::uint8_t* from) { std::memcpy(&value, from, kBytes); }
};
template <>
struct FieldCodec<std::string> {
  static constexpr std::size_t kBytes = 96;
  static void Pack(const std::string& value, std::uint8_t* to);
  static void Unpack(std::string& value, const std::uint8_t* from);
};
template <>
struct FieldCodec<std::vector<std::uint8_t>> {
  static constexpr std::size_t kCapacity = zro::Table::kMaxImageBytes;
  static constexpr std::size_t kBytes = 2 + kCapacity;  ///< u16 length in front
  static void Pack(const std::vector<std::uint8_t>& value, std::uint8_t* to);
  static void Unpack(std::vector<std::uint8_t>& value, const std::uint8_t* from);
};

template <typename T>
inline constexpr std::size_t kItemBytes = std::apply(
    []<typename... M>(const ItemField<T, M>&...) { return (FieldCodec<M>::kBytes + ...); },
    ItemLayout<T>::kFields);

/// Packs into kItemBytes<T> bytes.
template <typename T>
inline void PackItem(const T& item, std::uint8_t* to) {
  std::apply(
      [&]<typename... M>(const ItemField<T, M>&... field) {
        ((FieldCodec<M>::Pack(item.*field.member, to), to += FieldCodec<M>::kBytes), ...);
      },
      ItemLayout<T>::kFields);
}
template <typename T>
inline void UnpackItem(T& item, const std::uint8_t* from) {
  std::apply(
      [&]<typename... M>(const ItemField<T, M>&... field) {
        ((FieldCodec<M>::Unpack(item.*field.member, from), from += FieldCodec<M>::kBytes), ...);
      },
      ItemLayout<T>::kFields);
}

/// The 'F' text of an item's message, by message id (0 .. size of DataItems).
const std::vector<std::string>& ItemFormats();
/// {field name, unit} of every field that has a unit, each name once, in file order.
const std::vector<std::pair<std::string, std::string>>& ItemUnits();

}  // namespace zrobench
