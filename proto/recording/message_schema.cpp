#include "proto/recording/message_schema.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <array>
#include <vector>

#include "proto/schema/foxglove.pb.h"
#include "proto/schema/recording.pb.h"

namespace tandem::rec {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FileDescriptor;

const Descriptor* descriptor_of(MessageKind kind) {
  const std::array<const Descriptor*, kMessageKinds> all{
      recording::Seat::descriptor(),      recording::Tool::descriptor(),        recording::Authority::descriptor(),
      recording::Energy::descriptor(),    recording::SessionTick::descriptor(), recording::Inputs::descriptor(),
      recording::Link::descriptor(),      recording::Event::descriptor(),       recording::Mark::descriptor(),
      recording::Sheet::descriptor(),     recording::Counts::descriptor(),      foxglove::SceneUpdate::descriptor(),
      foxglove::FrameTransform::descriptor(), foxglove::PoseInFrame::descriptor(), foxglove::Log::descriptor()};
  return all[static_cast<std::size_t>(kind)];
}

void add_with_imports(const FileDescriptor& file, std::vector<const FileDescriptor*>& files) {
  if (std::ranges::find(files, &file) != files.end()) return;
  for (int i = 0; i < file.dependency_count(); ++i) add_with_imports(*file.dependency(i), files);
  files.push_back(&file);
}

}  // namespace

std::string message_name(MessageKind kind) { return descriptor_of(kind)->full_name(); }

std::string message_schema(MessageKind kind) {
  std::vector<const FileDescriptor*> files;
  add_with_imports(*descriptor_of(kind)->file(), files);
  google::protobuf::FileDescriptorSet set;
  for (const FileDescriptor* file : files) file->CopyTo(set.add_file());
  return set.SerializeAsString();
}

}  // namespace tandem::rec
