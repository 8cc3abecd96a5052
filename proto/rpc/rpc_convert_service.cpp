#include "proto/rpc/rpc_convert_service.h"

#include <algorithm>

#include "proto/rpc/rpc_bounds.h"

namespace tandem::rpc {

bool read(const pb::rpc::Elsewhere& in, Elsewhere& out) {
  out.address = in.address();
  out.voucher = to_bytes(in.voucher());
  out.revision = in.revision();
  if (!in.session_id().empty() && !take(in.session_id(), out.id.emplace())) return false;
  return is_address(out.address) && take(in.key(), out.key) && !out.voucher.empty() &&
         out.voucher.size() <= kVoucherMax && take_name(in.session_name(), out.session);
}
void write(const Elsewhere& in, pb::rpc::Elsewhere& out) {
  out.set_address(in.address);
  out.set_key(text_of(in.key));
  out.set_voucher(text_of(in.voucher));
  out.set_session_name(in.session);
  if (in.id) out.set_session_id(text_of(*in.id));
  out.set_revision(in.revision);
}

bool read_members(const google::protobuf::RepeatedPtrField<std::string>& in, std::vector<std::string>& out) {
  out.assign(in.begin(), in.end());
  return out.size() <= kMembersMax && std::ranges::all_of(out, [](const std::string& a) { return is_address(a); });
}

}  // namespace tandem::rpc
