"""Material colours of all samples, as red, green and blue from 0 to 1."""

COLOURS = {
    "fur": (0.878, 0.424, 0.118),
    "cream": (0.973, 0.937, 0.875),
    "dark": (0.220, 0.165, 0.150),
    "sea": (0.145, 0.380, 0.549),
    "sky": (0.310, 0.620, 0.780),
    "night": (0.180, 0.190, 0.250),
    "slate": (0.250, 0.310, 0.430),
}
