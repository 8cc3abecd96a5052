#include "netsim/models/link_text.h"

#include <array>

#include "common/base/format.h"

namespace tandem::netsim {
namespace {

double ms(Duration d) { return seconds(d) * 1e3; }
double percent(double share) { return share * 100; }
unsigned long long number(std::uint64_t n) { return n; }

std::string distribution_words(const BodySpec& body) {
  using Kind = BodySpec::Kind;
  switch (body.kind) {
    case Kind::kNone:
      break;
    case Kind::kUniform:
      return format("uniform %g to %g ms", ms(body.low), ms(body.high));
    case Kind::kLogNormal:
      return format("log-normal, median %g ms, shape %g", ms(body.scale), body.shape);
    case Kind::kLogLogistic:
      return format("log-logistic, median %g ms, shape %g", ms(body.scale), body.shape);
    case Kind::kTruncatedNormal:
      return format("normal, mean %g ms, sd %g ms", ms(body.scale), ms(body.sd));
    case Kind::kExponential:
      return format("exponential, mean %g ms", ms(body.scale));
    case Kind::kGamma:
      return format("gamma, shape %g, scale %g ms", body.shape, ms(body.scale));
    case Kind::kHyperExponential:
      return format("one of %zu exponentials", body.phases.size());
    case Kind::kPareto:
      return format("Pareto, least %g ms, shape %g", ms(body.scale), body.shape);
    case Kind::kEmpirical:
      return format("empirical, %zu quantiles", body.quantiles.size());
  }
  return {};
}

std::string body_words(const BodySpec& body) {
  std::string text = distribution_words(body);
  if (text.empty()) return text;
  if (body.kind != BodySpec::Kind::kUniform) text += format(", at most %g ms", ms(body.longest()));
  if (body.tau > Duration::zero()) text += format(", correlated over %g ms", ms(body.tau));
  return text;
}

/// Line of parts separated by "; ".
class Line {
 public:
  void add(const std::string& part) {
    if (!part.empty()) text_ += (text_.empty() ? "" : "; ") + part;
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

void add_outages(const PathSpec& path, Line& line) {
  constexpr std::array kModes{"", ", held", ", held but for the newest"};
  for (const OutageSpec& o : path.outages) {
    std::string text = format("outage of %g ms", ms(o.length));
    if (o.length_max > o.length) text += format(" to %g ms", ms(o.length_max));
    text += o.mean_gap > Duration::zero() ? format(" every %g s on average", seconds(o.mean_gap))
            : o.period > Duration::zero() ? format(" from %g s, every %g s", seconds(o.start), seconds(o.period))
                                          : format(" at %g s", seconds(o.start));
    line.add(text + kModes[static_cast<std::size_t>(o.mode)]);
  }
}

void add_loss(const LossSpec& loss, Line& line) {
  if (loss.probability > 0) line.add(format("loss %g %%", percent(loss.probability)));
  if (const auto& p = loss.periods)
    line.add(format("bad periods of %g ms between good ones of %g ms, loss %g / %g %%", ms(p->bad_mean),
                    ms(p->good_mean), percent(p->loss_bad), percent(p->loss_good)));
  if (const auto& g = loss.gilbert_elliott)
    line.add(format("loss of Gilbert-Elliott p %g, r %g, h %g, k %g", g->p, g->r, g->h, g->k));
  if (const auto& f = loss.four_state)
    line.add(
        format("loss of four states p13 %g, p31 %g, p32 %g, p23 %g, p14 %g", f->p13, f->p31, f->p32, f->p23, f->p14));
  if (const auto& b = loss.bursts)
    line.add(format("loss bursts %g per s, length %g %s, at most %g", b->rate_per_s, b->length,
                    b->unit == LossBurstsSpec::Unit::kDatagrams ? "datagrams" : "ms", b->cap));
  if (loss.pattern) line.add("loss by a pattern");
  if (const auto& c = loss.congestion)
    line.add(format("loss up to %g %% with a wait of %g to %g ms, %g %% in a stall", percent(c->probability),
                    ms(c->wait_low), ms(c->wait_high), percent(c->in_stall)));
  if (loss.trace) line.add("recorded loss");
}

void add_rate(const RateSpec& rate, Line& line) {
  if (!rate.present() && !rate.recorded) return;
  std::string text = rate.trace || rate.recorded ? std::string("recorded capacity")
                                                 : format("rate %g kbit/s", static_cast<double>(rate.bits_per_s) / 1e3);
  if (rate.queue_bytes > 0) text += format(", queue of %llu bytes", number(rate.queue_bytes));
  if (rate.queue_datagrams > 0) text += format(", queue of %llu datagrams", number(rate.queue_datagrams));
  if (rate.queue_wait) text += format(", queue of %g ms", ms(*rate.queue_wait));
  if (rate.drop == RateSpec::Drop::kHead) text += ", dropped at the head";
  if (rate.codel) text += format(", CoDel %g / %g ms", ms(rate.codel->target), ms(rate.codel->interval));
  if (rate.competing_peak > Duration::zero())
    text += format(", a TCP flow beside it fills %g ms every %g s", ms(rate.competing_peak),
                   seconds(rate.competing_period));
  line.add(text);
}

void add_delay(const PathSpec& path, Line& line) {
  if (path.floor > Duration::zero()) line.add(format("delay %g ms", ms(path.floor)));
  if (path.trace) line.add("recorded delay");
  if (const std::string body = body_words(path.body); !body.empty()) line.add("jitter " + body);
  for (const RegimeSpec& r : path.regimes) {
    const std::string body = body_words(r.body);
    line.add(format("for %g s on average delay %g ms", seconds(r.mean), ms(r.floor)) +
             (body.empty() ? "" : " and jitter " + body));
  }
  if (const BoundarySpec& b = path.boundary; b.period > Duration::zero())
    line.add(format("every %g s a stall of %g to %g ms, delay up to %g ms, loss %g %% within %g ms", seconds(b.period),
                    ms(b.stall_low), ms(b.stall_high), ms(b.floor_high), percent(b.loss), ms(b.loss_window)));
  if (const StallSpec& s = path.stall; s.rate_per_s > 0)
    line.add(format("stalls %g per s of at least %g, at most %g ms", s.rate_per_s, ms(s.length_min), ms(s.cap)));
  if (path.slots.period > Duration::zero()) line.add(format("leaves in slots every %g ms", ms(path.slots.period)));
  if (path.order == ArrivalOrder::kFree) line.add("overtaking allowed");
}

}  // namespace

std::string path_text(const PathSpec& path) {
  Line line;
  add_outages(path, line);
  add_loss(path.loss, line);
  if (path.mtu.bytes > 0)
    line.add(format("MTU %u bytes, above it %s", path.mtu.bytes,
                    path.mtu.above == MtuSpec::Above::kDrop ? "dropped" : "fragments"));
  add_rate(path.rate, line);
  if (path.corruption.probability > 0) {
    constexpr std::array kModes{"dropped by the checksum", "wrong bits", "truncated"};
    line.add(format("damaged %g %%, %s", percent(path.corruption.probability),
                    kModes[static_cast<std::size_t>(path.corruption.mode)]));
  }
  add_delay(path, line);
  if (path.reorder.probability > 0)
    line.add(format("reordered %g %% by %u", percent(path.reorder.probability), path.reorder.displacement));
  if (path.duplicate.probability > 0) line.add(format("duplicates %g %%", percent(path.duplicate.probability)));
  return line.text().empty() ? "perfect" : line.text();
}

std::string link_text(const LinkSpec& link, const std::string& indent) {
  const std::string up = path_text(link.up), down = path_text(link.down);
  const std::string shared = link.shared ? indent + "shared by all clients\n" : "";
  if (up == down) return indent + "each direction: " + up + "\n" + shared;
  return indent + "up: " + up + "\n" + indent + "down: " + down + "\n" + shared;
}

}  // namespace tandem::netsim
