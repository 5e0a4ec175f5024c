#include "common/mission/located.hpp"

#include <cmath>
#include <cstdio>

#include "common/base/ensure.hpp"

namespace gyre::mission {

using google::protobuf::FieldDescriptor;
using google::protobuf::TextFormat;

std::string show(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

const FieldDescriptor& Located::descriptor(const char* field) const {
  const FieldDescriptor* found = message_->GetDescriptor()->FindFieldByName(field);
  GYRE_ENSURE(found != nullptr, "the reader and idl/mission.proto disagree about a field's name");
  return *found;
}

bool Located::has(const char* field) const {
  return message_->GetReflection()->HasField(*message_, &descriptor(field));
}

int Located::count(const char* field) const {
  return message_->GetReflection()->FieldSize(*message_, &descriptor(field));
}

std::string Located::path_to(const char* field) const {
  return path_.empty() ? field : path_ + "." + field;
}

Located Located::nested(const char* field, int index) const {
  const FieldDescriptor& description = descriptor(field);
  const google::protobuf::Reflection& reflection = *message_->GetReflection();
  Located out = *this;
  out.path_ = path_to(field);
  if (index >= 0) out.path_ += "[" + std::to_string(index) + "]";
  out.message_ = index >= 0 ? &reflection.GetRepeatedMessage(*message_, &description, index)
                            : &reflection.GetMessage(*message_, &description);
  if (locations_ == nullptr) return out;
  const TextFormat::ParseLocation at = locations_->GetLocation(&description, index);
  if (at.line >= 0) {
    out.line_ = at.line;
    out.column_ = at.column;
  }
  out.locations_ = locations_->GetTreeForNested(&description, index);
  return out;
}

Located Located::child(const char* field) const {
  return nested(field, -1);
}

std::vector<Located> Located::children(const char* field) const {
  std::vector<Located> out;
  const int size = count(field);
  for (int i = 0; i < size; ++i) out.push_back(nested(field, i));
  return out;
}

Located Located::required_child(const char* field, const std::string& cure) const {
  if (!has(field)) complain(field, "is missing; " + cure);
  return child(field);
}

bool Located::sound(const char* field, const Span& span) const {
  if (!has(field)) return false;
  const double value = message_->GetReflection()->GetDouble(*message_, &descriptor(field));
  return std::isfinite(value) && value >= span.min && value <= span.max;
}

double Located::number(const char* field, const Span& span, std::optional<double> absent) const {
  const std::string allowed =
      "a number from " + show(span.min) + " to " + show(span.max) + (*span.unit != '\0' ? " " : "") + span.unit;
  if (!has(field)) {
    if (!absent) complain(field, "is missing; give " + allowed);
    return absent.value_or(span.min);
  }
  const double value = message_->GetReflection()->GetDouble(*message_, &descriptor(field));
  if (sound(field, span)) return value;
  complain(field, "is " + show(value) + "; give " + allowed);
  return absent.value_or(span.min);
}

std::optional<double> Located::optional_number(const char* field, const Span& span) const {
  if (!has(field)) return std::nullopt;
  return number(field, span);
}

Eigen::Vector3d Located::vector(const char* field, const Span& span) const {
  const Located components = child(field);
  return {components.number("x", span, 0.0), components.number("y", span, 0.0), components.number("z", span, 0.0)};
}

bool Located::flag(const char* field, bool absent) const {
  return has(field) ? message_->GetReflection()->GetBool(*message_, &descriptor(field)) : absent;
}

std::uint32_t Located::whole_number(const char* field, std::uint32_t min, std::uint32_t max) const {
  const std::string allowed = "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  if (!has(field)) {
    complain(field, "is missing; give " + allowed);
    return 0;
  }
  const std::uint32_t value = message_->GetReflection()->GetUInt32(*message_, &descriptor(field));
  if (value < min || value > max) {
    complain(field, "is " + std::to_string(value) + "; give " + allowed);
    return 0;
  }
  return value;
}

void Located::complain(const std::string& text) const {
  complaints_->add(line_, column_, path_, text);
}

void Located::complain(const char* field, const std::string& text) const {
  int line = line_;
  int column = column_;
  const FieldDescriptor& description = descriptor(field);
  if (locations_ != nullptr && !description.is_repeated()) {
    const TextFormat::ParseLocation at = locations_->GetLocation(&description, -1);
    if (at.line >= 0) {
      line = at.line;
      column = at.column;
    }
  }
  complaints_->add(line, column, path_to(field), text);
}

}  // namespace gyre::mission
