#include "ground/recording/core/mcap_stream.hpp"

#include <zlib.h>

#include <utility>

#include "common/base/text.hpp"

namespace gyre::ground {

Result<McapStream> McapStream::open(const McapSource& source) {
  if (auto wrong = judge_beginning(source)) return *wrong;
  McapStream stream(source);
  stream.crc_ = static_cast<std::uint32_t>(::crc32_z(0, kMcapMagic.data(), kMcapMagic.size()));
  return stream;
}

std::optional<Message> McapStream::next() {
  for (;;) {
    if (auto message = next_of_chunk()) return message;
    if (loose_) return std::exchange(loose_, std::nullopt);
    if (over_ || !read_record()) return std::nullopt;
  }
}

bool McapStream::read_record() {
  over_ = true;  // unless all goes well
  const std::uint64_t size = source_->size();
  if (at_ >= size || size - at_ < kRecordHead) {
    problems_.add(at_, "the file was cut off here: what was recorded last is missing");
    return false;
  }
  const auto head = read_head(*source_, at_);
  if (!head) {
    problems_.add(at_, "the file cannot be read here");
    return false;
  }
  if (head->opcode == Opcode{0}) {
    problems_.add(at_, "no record begins here: the file is damaged, and nothing behind can be found");
    return false;
  }
  if (head->length > size - at_ - kRecordHead) {
    problems_.add(
        at_,
        text("the file was cut off in the record that begins here: it is to have %llu bytes and has %llu",
             static_cast<unsigned long long>(head->length), static_cast<unsigned long long>(size - at_ - kRecordHead)));
    return false;
  }
  const std::uint64_t place = at_;
  if (head->length > kMaxRecordBytes) {
    all_read_ = false;
    if (head->opcode != Opcode::kAttachment) {
      problems_.add(
          place, text("a record of %llu bytes is passed over: %llu are the most",
                      static_cast<unsigned long long>(head->length), static_cast<unsigned long long>(kMaxRecordBytes)));
    }
  } else {
    record_.resize(static_cast<std::size_t>(kRecordHead + head->length));
    if (!source_->read(place, record_.size(), record_.data())) {
      problems_.add(place, "the file cannot be read here");
      return false;
    }
  }
  at_ += kRecordHead + head->length;
  over_ = false;
  if (head->length <= kMaxRecordBytes) take(*head, place);
  return !over_;
}

void McapStream::take(const RecordHead& head, std::uint64_t place) {
  ByteReader content(record_.data() + kRecordHead, record_.size() - kRecordHead);
  switch (head.opcode) {
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMetadata:
      if (auto wrong = directory_.learn(head.opcode, content)) problems_.add(place, std::move(*wrong));
      break;
    case Opcode::kMessage:
      loose_ = message_of(content, place);
      break;
    case Opcode::kChunk: {
      const auto packed = read_chunk(content);
      auto records = packed ? unpack(*packed) : Result<Bytes>(Error{"a chunk whose fields do not fit into it"});
      if (!records) {
        problems_.add(place, records.error().text);
        break;
      }
      chunk_ = std::move(records).value();
      in_chunk_ = 0;
      chunk_place_ = place;
      break;
    }
    case Opcode::kDataEnd:
      end_of_data(content);
      return;
    case Opcode::kFooter:  // before a data end: of a file without one
      over_ = true;
      whole_ = head.length == kFooterBytes && source_->size() - at_ == kMcapMagic.size();
      if (!whole_) problems_.add(place, "the file's end is said to be here, and more follows: the file is damaged");
      if (whole_ && content.number<std::uint64_t>() != 0) {
        problems_.add(place, "the data's end is not marked: the file is damaged, or its writer left it out");
      }
      return;
    default:
      break;
  }
  crc_ = static_cast<std::uint32_t>(::crc32_z(crc_, record_.data(), record_.size()));
}

void McapStream::end_of_data(ByteReader content) {
  over_ = true;
  if (content.left() != 4) return problems_.add(at_, "the end of the data is no such record: the file is damaged");
  const auto expected = content.number<std::uint32_t>();
  whole_ = true;
  if (all_read_ && expected != 0 && expected != crc_) {
    problems_.add(at_, "the checksum of all that was recorded is wrong: bytes were changed after they were written");
  }
}

std::optional<Message> McapStream::next_of_chunk() {
  while (in_chunk_ < chunk_.size()) {
    ByteReader reader(chunk_.data() + in_chunk_, chunk_.size() - in_chunk_);
    const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
    const auto length = reader.number<std::uint64_t>();
    const std::uint8_t* const from = reader.take(length);
    if (!from) {
      problems_.add(chunk_place_, "a chunk whose records do not fit into it");
      break;
    }
    in_chunk_ += reader.at();
    const ByteReader content(from, static_cast<std::size_t>(length));
    if (opcode == Opcode::kMessage) {
      if (auto message = message_of(content, chunk_place_)) return message;
    } else if (opcode == Opcode::kSchema || opcode == Opcode::kChannel) {
      if (auto wrong = directory_.learn(opcode, content)) problems_.add(chunk_place_, std::move(*wrong));
    }
  }
  chunk_.clear();
  in_chunk_ = 0;
  return std::nullopt;
}

std::optional<Message> McapStream::message_of(ByteReader content, std::uint64_t place) {
  auto message = read_message(content);
  if (!message) {
    problems_.add(place, "a message whose fields do not fit into it");
  } else if (directory_.channels().count(message->channel) == 0) {
    problems_.add(
        place, text("a message of the channel %u, which was not told before", static_cast<unsigned>(message->channel)));
    return std::nullopt;
  }
  return message;
}

}  // namespace gyre::ground
