#include "proto/text/message_validator.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "proto/schema/limits.pb.h"

namespace tandem::text {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

/// `[0, 1e5] N/m`, `(0, 1000] 1/s`, `> 0`
std::string range_text(const pb::Limits& limit) {
  const bool low = limit.has_min() || limit.has_above();
  const std::string from = limit.has_above() ? "(" + number_text(limit.above())
                           : low             ? "[" + number_text(limit.min())
                                             : "(-inf";
  const std::string to = limit.has_max() ? number_text(limit.max()) + "]" : "inf)";
  std::string text = from + ", " + to;
  if (!limit.unit().empty() && limit.unit() != "1") text += " " + limit.unit();
  return text;
}

bool in_range(const pb::Limits& limit, double value) {
  return (!limit.has_min() || value >= limit.min()) && (!limit.has_above() || value > limit.above()) &&
         (!limit.has_max() || value <= limit.max());
}

bool is_name(std::string_view text) {
  const auto legal = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !text.empty() && text.size() <= 32 && std::all_of(text.begin(), text.end(), legal);
}

/// The value at `index` of a repeated numeric field, or of a singular one (index -1), as double.
double number(const Message& m, const FieldDescriptor& f, int index) {
  const Reflection& r = *m.GetReflection();
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return index < 0 ? r.GetDouble(m, &f) : r.GetRepeatedDouble(m, &f, index);
    case FieldDescriptor::CPPTYPE_FLOAT:
      return static_cast<double>(index < 0 ? r.GetFloat(m, &f) : r.GetRepeatedFloat(m, &f, index));
    case FieldDescriptor::CPPTYPE_UINT32:
      return index < 0 ? r.GetUInt32(m, &f) : r.GetRepeatedUInt32(m, &f, index);
    case FieldDescriptor::CPPTYPE_INT32:
      return index < 0 ? r.GetInt32(m, &f) : r.GetRepeatedInt32(m, &f, index);
    case FieldDescriptor::CPPTYPE_UINT64:
      return static_cast<double>(index < 0 ? r.GetUInt64(m, &f) : r.GetRepeatedUInt64(m, &f, index));
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(index < 0 ? r.GetInt64(m, &f) : r.GetRepeatedInt64(m, &f, index));
    default:
      return 0;
  }
}

void check_value(MessageValidator& validator, const Message& m, const FieldDescriptor& f, int index,
                 const std::string& path) {
  const Reflection& r = *m.GetReflection();
  const pb::Limits& limit = f.options().GetExtension(pb::limit);
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      validator.check_limits(index < 0 ? r.GetMessage(m, &f) : r.GetRepeatedMessage(m, &f, index), path);
      return;
    case FieldDescriptor::CPPTYPE_STRING: {
      const std::string text = index < 0 ? r.GetString(m, &f) : r.GetRepeatedString(m, &f, index);
      if (limit.name() && !is_name(text)) validator.error(path, "a name has 1 to 32 characters of A-Z a-z 0-9 _ -");
      return;
    }
    case FieldDescriptor::CPPTYPE_ENUM: {
      const int value = index < 0 ? r.GetEnumValue(m, &f) : r.GetRepeatedEnumValue(m, &f, index);
      if (f.enum_type()->FindValueByNumber(value) == nullptr)
        validator.error(path, "no such enumerator", std::to_string(value));
      return;
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      return;
    default:
      validator.check_number(f, number(m, f, index), path);
  }
}

/// Shortens the exponent: 1e+05 -> 1e5, 5.5e-05 -> 5.5e-5.
std::string short_exponent(std::string text) {
  const auto e = text.find('e');
  if (e == std::string::npos) return text;
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  const auto digits = text.find_first_of("0123456789", e);
  if (text[digits] == '0') text.erase(digits, 1);
  return text;
}

struct Row {
  std::string key, value, unit;
};

void list(const Message& m, const std::string& path, std::vector<Row>& rows) {
  const Reflection& r = *m.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  r.ListFields(m, &fields);
  for (const auto* f : fields) {
    const int count = f->is_repeated() ? r.FieldSize(m, f) : 1;
    for (int i = 0; i < count; ++i) {
      const int index = f->is_repeated() ? i : -1;
      const std::string key = child_path(path, f->name(), index);
      const std::string& unit = f->options().GetExtension(pb::limit).unit();
      switch (f->cpp_type()) {
        case FieldDescriptor::CPPTYPE_MESSAGE:
          list(index < 0 ? r.GetMessage(m, f) : r.GetRepeatedMessage(m, f, index), key, rows);
          break;
        case FieldDescriptor::CPPTYPE_STRING:
          rows.push_back({key, '"' + (index < 0 ? r.GetString(m, f) : r.GetRepeatedString(m, f, index)) + '"', ""});
          break;
        case FieldDescriptor::CPPTYPE_ENUM:
          rows.push_back({key, r.GetEnum(m, f)->name(), ""});
          break;
        case FieldDescriptor::CPPTYPE_BOOL:
          rows.push_back({key, r.GetBool(m, f) ? "true" : "false", ""});
          break;
        default:
          rows.push_back({key, number_text(number(m, *f, index)), unit == "1" ? "" : unit});
      }
    }
  }
}

}  // namespace

std::string number_text(double value) {
  char buffer[32];
  const auto shortest = std::to_chars(buffer, buffer + sizeof buffer, value);
  std::string exact = short_exponent({buffer, shortest.ptr});
  // Prefers 12 digits if shorter: they drop the error that a unit conversion leaves in the last bit.
  const auto rounded = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 12);
  std::string meant = short_exponent({buffer, rounded.ptr});
  return exact.size() <= meant.size() ? exact : meant;
}

std::string child_path(std::string_view parent, std::string_view field, int index) {
  std::string path(parent);
  if (!path.empty()) path += '.';
  path += field;
  if (index >= 0) path += "[" + std::to_string(index) + "]";
  return path;
}

SourceLocation MessageValidator::location(std::string_view path) const {
  if (const auto it = locations_.find(path); it != locations_.end()) return it->second;
  const auto dot = path.rfind('.');
  if (dot == std::string_view::npos) return {};
  SourceLocation around = location(path.substr(0, dot));
  around.value.clear();
  return around;
}

void MessageValidator::error(std::string_view path, std::string message, std::string_view value) {
  SourceLocation at = location(path);
  if (!is_set(path)) at.value = value;
  error_at(at, path, std::move(message));
}

void MessageValidator::error_at(const SourceLocation& place, std::string_view path, std::string message) {
  if (errors_.size() >= kErrorsMax) {
    ++unlisted_;
    return;
  }
  errors_.push_back({file_, place.line, place.column, std::string(path), place.value, std::move(message)});
}

void MessageValidator::check_number(const FieldDescriptor& field, double value, std::string_view path) {
  const pb::Limits& limit = field.options().GetExtension(pb::limit);
  if (!std::isfinite(value)) {
    error(path, "must be a finite number, in " + range_text(limit), number_text(value));
  } else if (!in_range(limit, value)) {
    error(path, "must be in " + range_text(limit), number_text(value));
  }
}

void MessageValidator::check_limits(const Message& message, const std::string& path) {
  const auto* descriptor = message.GetDescriptor();
  const Reflection& r = *message.GetReflection();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const FieldDescriptor& f = *descriptor->field(i);
    const pb::Limits& limit = f.options().GetExtension(pb::limit);
    if (f.is_repeated()) {
      const int count = r.FieldSize(message, &f);
      if (limit.items() > 0 && static_cast<std::uint32_t>(count) > limit.items()) {
        error(child_path(path, f.name(), static_cast<int>(limit.items())),
              "at most " + std::to_string(limit.items()) + " are allowed, here are " + std::to_string(count));
      }
      for (int item = 0; item < count; ++item) check_value(*this, message, f, item, child_path(path, f.name(), item));
    } else if (const std::string key = child_path(path, f.name()); r.HasField(message, &f)) {
      check_value(*this, message, f, -1, key);
    } else if (limit.given() && !is_set(key)) {  // written but unreadable: already reported
      error(key, "is missing");
    }
  }
}

InputErrors MessageValidator::take() {
  std::stable_sort(errors_.begin(), errors_.end(), [](const InputError& a, const InputError& b) {
    const auto rank = [](const InputError& e) { return std::pair(e.line == 0, std::pair(e.line, e.column)); };
    return rank(a) < rank(b);
  });
  if (unlisted_ > 0) {
    errors_.push_back({file_, 0, 0, "", "", "and " + std::to_string(unlisted_) + " more mistakes"});
    unlisted_ = 0;
  }
  return std::exchange(errors_, {});
}

std::string listing(const Message& message) {
  std::vector<Row> rows;
  list(message, "", rows);
  std::size_t key_width = 0, value_width = 0;
  for (const auto& row : rows) {
    key_width = std::max(key_width, row.key.size());
    value_width = std::max(value_width, row.value.size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = row.key + std::string(key_width + 2 - row.key.size(), ' ') + row.value;
    if (!row.unit.empty()) line += std::string(value_width + 2 - row.value.size(), ' ') + row.unit;
    text += line + "\n";
  }
  return text;
}

}  // namespace tandem::text
