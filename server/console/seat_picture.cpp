#include "server/console/seat_picture.h"

#include <cmath>

#include "server/console/json_text.h"
#include "server/console/state_words.h"

namespace tandem::console {
namespace {

using nlohmann::json;

json vector_json(const std::optional<std::array<double, 3>>& v) {
  return v && std::isfinite((*v)[0] + (*v)[1] + (*v)[2]) ? json(*v) : json(nullptr);
}

}  // namespace

std::string seat_json(const SeatPicture& p) {
  return json_text({{"type", "seat"},
                    {"seat", p.seat},
                    {"joined", p.joined},
                    {"heard", p.heard},
                    {"phase", page_word(p.session)},
                    {"gate", p.joined ? json(page_word(p.gate)) : json(nullptr)},
                    {"engaged", p.gate == wire::GateState::kRampIn || p.gate == wire::GateState::kActive},
                    {"alpha", p.authority},
                    {"force_limit_n", p.force_limit_n},
                    {"x", vector_json(p.x)},
                    {"f", vector_json(p.f)},
                    {"target", vector_json(p.target)},
                    {"workspace", json{p.workspace_min, p.workspace_max}},
                    {"limited", p.limited},
                    {"ended", p.ended.empty() ? json(nullptr) : json(p.ended)}});
}

}  // namespace tandem::console
