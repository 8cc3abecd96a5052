#include "common/control/energy_ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::control {
namespace {

constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Nanojoule, RoundsCreditsDownAndDebitsUp) {
  EXPECT_EQ(credit_nj(1.9e-9), 1U);
  EXPECT_EQ(debit_nj(1.1e-9), 2U);
  EXPECT_EQ(credit_nj(0.9e-9), 0U);
  EXPECT_EQ(debit_nj(1e-30), 1U);
  EXPECT_EQ(credit_nj(0.05), 50'000'000U);
  EXPECT_EQ(debit_nj(0), 0U);
  EXPECT_EQ(credit_nj(-1), 0U);
  EXPECT_EQ(debit_nj(-1), 0U);
  RandomStream random{1};
  for (int i = 0; i < 10000; ++i) {
    const double joule = std::pow(10.0, random.uniform(-12, 6));
    const long double exact = static_cast<long double>(joule) * 1e9L;
    const long double ulp = exact * 0x1p-52L;
    EXPECT_LE(static_cast<long double>(credit_nj(joule)), exact + ulp) << joule;
    EXPECT_GE(static_cast<long double>(debit_nj(joule)), exact - ulp) << joule;
    EXPECT_LE(debit_nj(joule) - credit_nj(joule), 1U) << joule;
  }
}

TEST(Nanojoule, AcceptsNonFiniteNumbers) {
  EXPECT_EQ(credit_nj(kNan), 0U);
  EXPECT_EQ(credit_nj(-kInf), 0U);
  EXPECT_EQ(debit_nj(kNan), kMax);
  EXPECT_EQ(debit_nj(kInf), kMax);
  EXPECT_LE(credit_nj(kInf), 1'000'000'000'000'000'000U);
  EXPECT_GE(debit_nj(1e9), credit_nj(1e9));
}

TEST(Nanojoule, SaturatesInsteadOfWrapping) {
  EXPECT_EQ(saturating_add(kMax, 1), kMax);
  EXPECT_EQ(saturating_add(kMax - 1, 1), kMax);
  EXPECT_EQ(saturating_add(kMax, kMax), kMax);
  EXPECT_EQ(saturating_add(2, 3), 5U);
}

TEST(EnergyLedger, SpendsExactlyItsInitialEnergy) {
  EnergyLedger ledger(0.05, 0.9);
  EXPECT_TRUE(ledger.spend(0.03));
  EXPECT_FALSE(ledger.spend(0.020000001));
  EXPECT_EQ(ledger.out_nj(), 30'000'000U);  // a rejected debit costs nothing
  EXPECT_TRUE(ledger.spend(0.02));
  EXPECT_EQ(ledger.margin_nj(), 0U);
  EXPECT_TRUE(ledger.spend(0));
  EXPECT_FALSE(ledger.spend(1e-15));
  EXPECT_TRUE(ledger.holds());
}

TEST(EnergyLedger, IgnoresOlderCounters) {
  EnergyLedger ledger(0, 0.9);
  ledger.receive(500);
  ledger.receive(300);
  ledger.receive(0);
  ledger.receive(500);
  EXPECT_EQ(ledger.margin_nj(), 500U);
  ledger.receive(700);
  EXPECT_EQ(ledger.margin_nj(), 700U);
}

TEST(EnergyLedger, SpendsOnlyTheAgreedShareOfHeat) {
  EnergyLedger ledger(0, 0.9);
  ledger.dissipate(1e-3);
  EXPECT_EQ(ledger.margin_nj(), 900'000U);
  EXPECT_EQ(ledger.in_nj(), 0U);  // heat is spent here and never sent as well
}

TEST(EnergyLedger, CreditsAbsorbedEnergyToTheOtherEnd) {
  EnergyLedger ledger(0, 0.9);
  ledger.absorb(0.5);
  EXPECT_EQ(ledger.in_nj(), 500'000'000U);
  EXPECT_EQ(ledger.margin_nj(), 0U);
}

TEST(EnergyLedger, ForfeitsEnergyAboveItsLimit) {
  EnergyLedger ledger(0.05, 0.9);
  ledger.receive(1'000'000'000);
  static_cast<void>(ledger.forfeit_above(0.1, 0));
  EXPECT_EQ(ledger.margin_nj(), 100'000'000U);
  EXPECT_TRUE(ledger.spend(0.1));
  static_cast<void>(ledger.forfeit_above(0.1, 0));
  EXPECT_EQ(ledger.margin_nj(), 0U);
  ledger.receive(1'000'000'010);  // a forfeited amount stays forfeited
  EXPECT_EQ(ledger.margin_nj(), 10U);
}

TEST(EnergyLedger, ForwardsSurplusEnergyExactlyOnce) {
  EnergyLedger here(0.05, 1), there(0, 1);
  const std::uint64_t heat = here.dissipate(0.2);
  EXPECT_EQ(heat, 200'000'000U);
  EXPECT_EQ(here.forfeit_above(0.1, heat), 150'000'000U);
  EXPECT_EQ(here.margin_nj(), 100'000'000U);  // removed here
  EXPECT_EQ(here.in_nj(), 150'000'000U);      // to be received there
  EXPECT_EQ(here.forfeit_above(0.1, heat), 0U);
  there.receive(here.in_nj());
  EXPECT_TRUE(there.spend(0.15));
  EXPECT_TRUE(here.spend(0.1));
  EXPECT_FALSE(there.spend(1e-9));
  EXPECT_FALSE(here.spend(1e-9));
  here.receive(1'000'000'000);
  EXPECT_EQ(here.forfeit_above(0, 7), 7U);  // never more than allowed: energy from the other end does not return
}

TEST(EnergyLedger, RejectsANonFiniteDebit) {
  EnergyLedger ledger(0.05, 0.9);
  EXPECT_FALSE(ledger.spend(kNan));
  EXPECT_FALSE(ledger.spend(kInf));
  EXPECT_FALSE(ledger.spend(1e300));
  EXPECT_EQ(ledger.out_nj(), 0U);
  ledger.absorb(kNan);
  ledger.dissipate(kNan);
  ledger.absorb(-kInf);
  EXPECT_EQ(ledger.in_nj(), 0U);
  EXPECT_EQ(ledger.margin_nj(), 50'000'000U);
}

TEST(EnergyLedger, SaturatesAtTheEndOfItsCounters) {
  EnergyLedger ledger(1, 1);
  ledger.receive(kMax);
  EXPECT_EQ(ledger.bound_nj(), kMax);
  EXPECT_TRUE(ledger.spend(1));
  ledger.dissipate(5);
  EXPECT_EQ(ledger.bound_nj(), kMax);
  for (int i = 0; i < 40; ++i) ledger.absorb(1e9);
  EXPECT_EQ(ledger.in_nj(), kMax);
  for (int i = 0; i < 40; ++i) ledger.spend_unchecked(1e9);
  EXPECT_EQ(ledger.out_nj(), kMax);
  EXPECT_EQ(ledger.margin_nj(), 0U);
  EXPECT_FALSE(ledger.spend(1e-9));
}

TEST(EnergyLedger, ReportsAnUncheckedOverdraft) {
  EnergyLedger ledger(0.05, 0.9);
  ledger.spend_unchecked(0.05);
  EXPECT_TRUE(ledger.holds());
  ledger.spend_unchecked(1e-9);
  EXPECT_FALSE(ledger.holds());
}

TEST(EnergyLedger, IsNeverOverdrawnAndNeverRunsBackwards) {
  const std::uint64_t last = test::seeds(200);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const double e0 = random.uniform(0, 0.1), eta = random.uniform();
    EnergyLedger ledger(e0, eta);
    std::uint64_t newest = 0, in = 0, out = 0;
    long double heat = 0, spent = 0, absorbed = 0;  // the same balance in joule, kept by the test
    for (int i = 0; i < 500; ++i) {
      const double joule = std::pow(10.0, random.uniform(-10, 0));
      switch (random.below(6)) {
        case 0:
          ledger.absorb(joule);
          absorbed += joule;
          break;
        case 1: {
          const std::uint64_t rx = random.below(2) == 0 ? newest + random.below(100'000'000) : random.below(newest + 1);
          newest = std::max(newest, rx);
          ledger.receive(rx);
          break;
        }
        case 2:
          ledger.dissipate(joule);
          heat += joule;
          break;
        case 3:
          static_cast<void>(ledger.forfeit_above(random.uniform(0, 0.2), 0));
          break;
        default:
          if (ledger.spend(joule)) spent += joule;
      }
      ASSERT_TRUE(ledger.holds()) << i;
      ASSERT_LE(spent, e0 + newest * 1e-9L + eta * heat + 1e-15L) << i;
      ASSERT_LE(ledger.in_nj() * 1e-9L, absorbed + 1e-15L) << i;
      ASSERT_GE(ledger.in_nj(), in);
      ASSERT_GE(ledger.out_nj(), out);
      in = ledger.in_nj();
      out = ledger.out_nj();
    }
  }
}

}  // namespace
}  // namespace tandem::control
