#pragma once

#include <complex>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/pe/depth_operator.hpp"

namespace earshot::pe {

/// How the march begins at range 0.
enum class Starter : unsigned char {
  kSelf,     ///< a point source, exact at every angle
  kGaussian  ///< a beam: for comparison with other codes, and where steep waves are not wanted
};

/// A point source of unit amplitude at 1 m in its water, at range 0.
struct StartingSource {
  double depth_m;
  double wavenumber_per_m;  ///< k_s, of the water around it
};

/// u at every node at range 0; u = (1 + X)^(1/4) p as in propagator.hpp, up to a constant factor.
///
///   self      u = delta(z - z_s)
///   Gaussian  u = k_s / sqrt(2 pi) (exp(-(k_s (z - z_s))^2 / 2) - exp(-(k_s (z + z_s))^2 / 2))
///
/// The self-starter is p(r) = (1 + X)^(-1/4) exp(i k0 r (sqrt(1 + X) - 1)) delta(z - z_s) at some small r > 0, because (1 + X)^(-1/4) of a
/// delta function cannot be held on a grid. The march carries u, to which that operator has not been applied yet, so it starts at r = 0,
/// and what it reads off within its first step is the self-starter at every r. The Gaussian radiates exp(-sin^2(angle) / 2) of the point
/// source at an angle to the horizontal: 0.5 dB less at 20 degrees, 2.2 dB at 45. Source: Collins, J. Acoust. Soc. Am. 92 (1992) 2069
/// (self-starter); Jensen et al., Computational Ocean Acoustics, 2nd ed., 6.4.1 (Gaussian).
///
/// On the nodes the delta function is u = (1 + c X) M^-1 t: t the weights by which a receiver there would be read (DepthTap), M the mass
/// matrix, and c = (k0 h)^2 / 12 for what the elements' mass is larger than the medium's. Between uniform elements that is t / h. Beside an
/// interface it is what makes the sound there and back alike: M at a node of the sea floor is that of half water and half sediment.
///   Deviation: there psi is the Gaussian, here u is, closer to the point source by sqrt(cos(angle)); width by k_s in place of k0.
/// Oracle: Starter.*, WavenumberIntegration.*
[[nodiscard]] std::vector<std::complex<double>> make_starter(Starter starter, const DepthOperator& depth_operator,
                                                             const StartingSource& source);

}  // namespace earshot::pe
