#include "corrector/node/object_dictionary.h"

#include "corrector/node/limit_objects.h"

namespace zro::node {
namespace {

constexpr auto kRo = SdoAccess::kReadOnly;
constexpr auto kRw = SdoAccess::kReadWrite;
constexpr auto kWo = SdoAccess::kWriteOnly;

// Ascending; rows of one index adjoin, its last row holds the highest sub-index.
constexpr SdoObject kObjects[] = {
    {0x1000, 0, 0, kRo, 4}, {0x1001, 0, 0, kRo, 1},   {0x1003, 0, 0, kRw, 1},
    {0x1003, 1, 8, kRo, 4}, {0x1008, 0, 0, kRo, 0},   {0x1009, 0, 0, kRo, 0},
    {0x100A, 0, 0, kRo, 0}, {0x1010, 0, 0, kRo, 1},   {0x1010, 1, 1, kRw, 4},
    {0x1010, 4, 4, kRw, 4}, {0x1011, 0, 0, kRo, 1},   {0x1011, 1, 1, kRw, 4},
    {0x1011, 4, 4, kRw, 4}, {0x1017, 0, 0, kRw, 2},   {0x1018, 0, 0, kRo, 1},
    {0x1018, 1, 4, kRo, 4}, {0x2000, 0, 0, kRo, 1},   {0x2000, 1, 2, kRo, 2},
    {0x2000, 7, 8, kRo, 4}, {0x2000, 10, 10, kRo, 1}, {0x2001, 0, 0, kRo, 0},
    {0x2004, 0, 0, kRo, 1}, {0x2004, 1, 1, kRw, 1},   {0x2004, 2, 2, kRo, 4},
    {0x2005, 0, 0, kWo, 0}, {0x2100, 0, 0, kRo, 1},   {0x2100, 1, 1, kRw, 1},
    {0x2100, 2, 5, kRw, 4}, {0x2100, 6, 6, kRw, 2},   {0x2100, 7, 7, kRw, 4},
    {0x2100, 8, 9, kRw, 2}, {0x2101, 0, 0, kRo, 1},   {0x2101, 1, 1, kRw, 4},
    {0x2101, 2, 2, kRw, 6}, {0x2101, 6, 6, kRw, 1},   {0x2200, 0, 0, kRo, 1},
    {0x2200, 1, 4, kRo, 4}, {0x2200, 5, 5, kWo, 4},   {0x2200, 6, 6, kRw, 4},
    {0x2201, 0, 0, kRo, 0},
};

std::uint8_t HighestSub(std::uint16_t index) {
  std::uint8_t highest = 0;
  for (const SdoObject& o : kObjects) {
    if (o.index == index) highest = o.last_sub;
  }
  return highest;
}

template <std::size_t kSize>
SdoAbort PutText(const char (&text)[kSize], ByteWriter* out) {
  out->PutBytes(text, kSize - 1);
  return SdoAbort::kNone;
}

SdoAbort PutU32(std::uint32_t value, ByteWriter* out) {
  out->Put(value, 4);
  return SdoAbort::kNone;
}

/// Decimal digits: no printf on the target.
void PutNumber(std::uint8_t value, ByteWriter* out) {
  if (value >= 10) PutNumber(value / 10, out);
  out->Put(static_cast<std::uint32_t>('0' + value % 10), 1);
}

SdoAbort PutVersion(const Identity& id, ByteWriter* out) {
  PutNumber(id.fw_major, out);
  out->Put('.', 1);
  PutNumber(id.fw_minor, out);
  out->Put('.', 1);
  PutNumber(id.fw_patch, out);
  return SdoAbort::kNone;
}

}  // namespace

const SdoObject* ObjectDictionary::Find(std::uint16_t index, std::uint8_t sub, SdoAbort* abort) {
  *abort = SdoAbort::kNoObject;
  for (const SdoObject& o : kObjects) {
    if (o.index != index) continue;
    if (sub >= o.first_sub && sub <= o.last_sub) return &o;
    *abort = SdoAbort::kNoSub;
  }
  return nullptr;
}

SdoAbort ObjectDictionary::Read(std::uint16_t index, std::uint8_t sub, std::uint8_t* out,
                                std::size_t capacity, std::size_t* size) {
  ByteWriter writer(out, capacity);
  SdoAbort abort = SdoAbort::kNone;
  const std::uint8_t highest = HighestSub(index);
  if (sub == 0 && highest > 0 && index != 0x1003) {
    writer.Put(highest, 1);
  } else if (index == 0x1003) {
    abort = ReadErrors(sub, &writer);
  } else if (index < 0x2000) {
    abort = ReadIdentity(index, sub, &writer);
  } else if (index < 0x2100) {
    abort = ReadTable(index, sub, &writer);
  } else if (index == 0x2100) {
    PutLimit(from_.corrector->limits(), sub, &writer);
  } else if (index == 0x2101) {
    abort = ReadTestModes(sub, &writer);
  } else {
    abort = ReadLog(index, sub, &writer);
  }
  *size = writer.size();
  return writer.ok() ? abort : SdoAbort::kOutOfMemory;
}

SdoAbort ObjectDictionary::ReadIdentity(std::uint16_t index, std::uint8_t sub,
                                        ByteWriter* out) const {
  const Identity& id = *from_.identity;
  const auto revision =
      static_cast<std::uint32_t>(id.fw_major << 16 | id.fw_minor << 8 | id.fw_patch);
  const std::uint32_t identity[] = {0, 0x5A524F31, revision, id.serial};  // no vendor id; "ZRO1"
  switch (index) {
    case 0x1001:
      out->Put(error_register(), 1);
      return SdoAbort::kNone;
    case 0x1008:
      return PutText("zrobench board", out);
    case 0x1009:
      PutNumber(id.hw_rev, out);
      return SdoAbort::kNone;
    case 0x100A:
      return PutVersion(id, out);
    case 0x1010:
    case 0x1011:
      return PutU32(1, out);  // on command, not by itself (CiA 301, 7.5.2.13)
    case 0x1017:
      out->Put(heartbeat_ms_, 2);
      return SdoAbort::kNone;
    case 0x1018:
      return PutU32(identity[sub - 1], out);
    default:
      return PutU32(0, out);  // 0x1000: no device profile
  }
}

SdoAbort ObjectDictionary::ReadErrors(std::uint8_t sub, ByteWriter* out) const {
  if (sub > errors_) return SdoAbort::kNoContent;
  if (sub > 0) return PutU32(error_history_[sub - 1], out);
  out->Put(static_cast<std::uint32_t>(errors_), 1);
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::ReadTable(std::uint16_t index, std::uint8_t sub, ByteWriter* out) {
  if (index == 0x2004) {
    if (sub == 1) out->Put(frozen_ ? 1 : 0, 1);
    if (sub == 2 && !frozen_) return SdoAbort::kWrongState;
    return sub == 2 ? PutU32(image_.generation(), out) : SdoAbort::kNone;
  }
  if (!frozen_) image_.Take(*from_.corrector);
  if (index == 0x2001) {
    out->PutBytes(image_.bytes(), image_.size());
    return SdoAbort::kNone;
  }
  switch (sub) {
    case 1:
      out->Put(image_.layout(), 2);
      break;
    case 2:
      out->Put(image_.entries(), 2);
      break;
    case 7:
      out->Put(image_.generation(), 4);
      break;
    case 8:
      out->Put(image_.crc32(), 4);
      break;
    default:
      out->Put(image_.origin(), 1);
      break;
  }
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::ReadTestModes(std::uint8_t sub, ByteWriter* out) const {
  if (sub == 1) return PutU32(from_.test_modes->unlocked() ? 1 : 0, out);
  if (sub == 6) {
    out->Put(from_.test_modes->load_pct(), 1);
    return SdoAbort::kNone;
  }
  for (int i = 0; i < kAxes; ++i) {
    out->Put(static_cast<std::uint16_t>(from_.test_modes->injection_lsb()[i]), 2);
  }
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::ReadLog(std::uint16_t index, std::uint8_t sub, ByteWriter* out) {
  EventLog& log = *from_.log;
  if (index == 0x2201) {
    std::uint8_t records[EventLog::kMaxRead * kLogRecordBytes];
    const std::uint32_t n = log.Peek(records);
    offered_to_ = log.passed() + n;
    out->PutBytes(records, n * kLogRecordBytes);
    return SdoAbort::kNone;
  }
  switch (sub) {
    case 1:
      return PutU32(log.total(), out);
    case 2:
      return PutU32(log.lost() + from_.corrector->lost_events(), out);
    case 3:
      return PutU32(log.oldest(), out);
    case 4:
      return PutU32(log.newest(), out);
    default:
      return PutU32(log.cursor(), out);
  }
}

void ObjectDictionary::OnUploaded(std::uint16_t index, std::uint8_t) {
  // The ring may have overwritten some of them meanwhile, and so moved on by itself.
  const std::uint32_t passed = from_.log->passed();
  if (index == 0x2201 && offered_to_ > passed) from_.log->Advance(offered_to_ - passed);
}

SdoAbort ObjectDictionary::Write(std::uint16_t index, std::uint8_t sub, const std::uint8_t* bytes,
                                 std::size_t size) {
  switch (index) {
    case 0x1003:
      return WriteErrors(bytes);
    case 0x1010:
    case 0x1011:
      return WriteStore(index, GetU32(bytes));
    case 0x1017:
      heartbeat_ms_ = GetU16(bytes);
      return SdoAbort::kNone;
    case 0x2004:
      return WriteFreeze(bytes[0]);
    case 0x2005:
      return WriteFactoryEntries(bytes, size);
    case 0x2100:
      return WriteLimit(sub, bytes);
    case 0x2101:
      return WriteTestModes(sub, bytes);
    case 0x2200:
      return WriteLog(sub, GetU32(bytes));
    default:
      return SdoAbort::kReadOnly;
  }
}

SdoAbort ObjectDictionary::WriteErrors(const std::uint8_t* bytes) {
  if (bytes[0] != 0) return SdoAbort::kRange;  // CiA 301, 7.5.2.5: only 0 may be written
  errors_ = 0;
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::WriteStore(std::uint16_t index, std::uint32_t signature) {
  const bool save = index == 0x1010;
  if (signature != (save ? kSaveSignature : kLoadSignature)) return SdoAbort::kCannotStore;
  const bool done = save ? from_.corrector->Commit() : from_.corrector->RestoreFactory();
  return done ? SdoAbort::kNone : SdoAbort::kCannotStore;
}

SdoAbort ObjectDictionary::WriteFreeze(std::uint8_t command) {
  if (command > 1) return SdoAbort::kRange;
  frozen_ = command == 1;
  if (frozen_) image_.Take(*from_.corrector);
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::WriteFactoryEntries(const std::uint8_t* bytes, std::size_t size) {
  if (!from_.test_modes->unlocked()) return SdoAbort::kWrongState;
  if (size == 0 || size % kFactoryEntryBytes != 0) return SdoAbort::kLength;
  for (const std::uint8_t* p = bytes; p < bytes + size; p += kFactoryEntryBytes) {
    const float zro_dps[kAxes] = {GetFloat(p + 4), GetFloat(p + 8), GetFloat(p + 12)};
    if (!from_.corrector->AddFactoryEntry(GetFloat(p), zro_dps, GetFloat(p + 16))) {
      return SdoAbort::kRange;
    }
  }
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::WriteLimit(std::uint8_t sub, const std::uint8_t* bytes) {
  Limits limits = from_.corrector->limits();
  const SdoAbort abort = SetLimit(sub, bytes, &limits);
  if (abort == SdoAbort::kNone) from_.corrector->SetLimits(limits);
  return abort;
}

SdoAbort ObjectDictionary::WriteTestModes(std::uint8_t sub, const std::uint8_t* bytes) {
  TestModes& modes = *from_.test_modes;
  if (sub == 1) return modes.Unlock(GetU32(bytes)) ? SdoAbort::kNone : SdoAbort::kRange;
  if (!modes.unlocked()) return SdoAbort::kWrongState;
  if (sub == 6) return modes.SetLoad(bytes[0]) ? SdoAbort::kNone : SdoAbort::kRange;
  const std::int16_t lsb[kAxes] = {static_cast<std::int16_t>(GetU16(bytes)),
                                   static_cast<std::int16_t>(GetU16(bytes + 2)),
                                   static_cast<std::int16_t>(GetU16(bytes + 4))};
  modes.SetInjection(lsb);
  return SdoAbort::kNone;
}

SdoAbort ObjectDictionary::WriteLog(std::uint8_t sub, std::uint32_t value) {
  if (sub == 6) {
    from_.log->SetCursor(value);
    return SdoAbort::kNone;
  }
  if (value != kClearSignature) return SdoAbort::kRange;
  from_.log->Clear();
  return SdoAbort::kNone;
}

void ObjectDictionary::AddError(std::uint16_t emcy_code, std::uint32_t event_seq) {
  for (int i = kErrorHistory - 1; i > 0; --i) error_history_[i] = error_history_[i - 1];
  error_history_[0] = emcy_code | event_seq << 16;
  if (errors_ < kErrorHistory) ++errors_;
}

}  // namespace zro::node
