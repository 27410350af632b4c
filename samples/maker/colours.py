"""Material colours of all samples, as red, green and blue from 0 to 1."""

COLOURS = {
    "fur": (0.878, 0.424, 0.118),
    "cream": (0.973, 0.937, 0.875),
    "dark": (0.220, 0.165, 0.150),
}
