#pragma once

namespace twin::pictures {

/// Whether plots are made for a paper as well.
enum class Paper {
  kNone,  ///< NAME.png and NAME.svg
  kToo,   ///< NAME.pdf as well, one column of a paper wide
};

}  // namespace twin::pictures
