#pragma once

namespace twin {

/// The double nearest to x written with nine significant digits, as every JSON file of results holds it.
double rounded(double x);

}  // namespace twin
