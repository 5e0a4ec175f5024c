#pragma once
// The alphabet of an MCAP file: records of numbers, texts and maps.

#include "common/base/bytes.hpp"
#include "ground/recording/core/mcap_format.hpp"

namespace gyre::ground {

/// Writes a record's head now, and its length once its content is there.
class RecordWriter : public ByteWriter {
 public:
  RecordWriter(Bytes& out, Opcode opcode) : ByteWriter(out), out_(out) {
    number(static_cast<std::uint8_t>(opcode));
    at_ = out.size();
    number(std::uint64_t{0});
  }
  ~RecordWriter() { overwrite(at_, static_cast<std::uint64_t>(out_.size() - at_ - 8)); }
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

 private:
  Bytes& out_;
  std::size_t at_ = 0;
};

}  // namespace gyre::ground
