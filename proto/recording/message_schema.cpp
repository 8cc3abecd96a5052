#include "proto/recording/message_schema.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "proto/schema/foxglove.pb.h"
#include "proto/schema/recording.pb.h"

namespace tandem::rec {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FileDescriptor;

const Descriptor* descriptor_of(MessageKind kind) {
  const std::array<const Descriptor*, kMessageKinds> all{
      recording::Seat::descriptor(),        recording::Tool::descriptor(),       recording::Authority::descriptor(),
      recording::SessionTick::descriptor(), recording::Inputs::descriptor(),     recording::Link::descriptor(),
      recording::Event::descriptor(),       recording::Mark::descriptor(),       recording::Sheet::descriptor(),
      recording::Counts::descriptor(),      foxglove::SceneUpdate::descriptor(), foxglove::FrameTransform::descriptor(),
      foxglove::PoseInFrame::descriptor(),  foxglove::Log::descriptor()};
  return all[static_cast<std::size_t>(kind)];
}

void add_with_imports(const FileDescriptor& file, std::vector<const FileDescriptor*>& files) {
  if (std::ranges::find(files, &file) != files.end()) return;
  for (int i = 0; i < file.dependency_count(); ++i) add_with_imports(*file.dependency(i), files);
  files.push_back(&file);
}

/// Adds the message and those in its fields, by their top-level messages.
void add_with_fields(const Descriptor& message, std::set<std::string>& names) {
  const Descriptor* top = &message;
  while (top->containing_type() != nullptr) top = top->containing_type();
  if (!names.insert(top->full_name()).second) return;
  for (int i = 0; i < top->field_count(); ++i) {
    if (top->field(i)->message_type() != nullptr) add_with_fields(*top->field(i)->message_type(), names);
    if (top->field(i)->enum_type() != nullptr && top->field(i)->enum_type()->containing_type() != nullptr)
      add_with_fields(*top->field(i)->enum_type()->containing_type(), names);
  }
}

}  // namespace

std::string message_name(MessageKind kind) { return descriptor_of(kind)->full_name(); }

std::string message_schema(MessageKind kind) {
  std::vector<const FileDescriptor*> files;
  add_with_imports(*descriptor_of(kind)->file(), files);
  std::set<std::string> names;
  add_with_fields(*descriptor_of(kind), names);
  google::protobuf::FileDescriptorSet set;
  for (const FileDescriptor* file : files) {
    google::protobuf::FileDescriptorProto whole;
    file->CopyTo(&whole);
    google::protobuf::FileDescriptorProto& out = *set.add_file();
    out = whole;
    out.clear_message_type();
    for (const auto& message : whole.message_type())
      if (names.contains(whole.package() + "." + message.name())) *out.add_message_type() = message;
  }
  return set.SerializeAsString();
}

}  // namespace tandem::rec
