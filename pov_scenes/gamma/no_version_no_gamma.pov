// Without `#version` and `assumed_gamma` colours are stored as they are: 0.5 becomes 128.
camera { location <0, 0, -3> look_at 0 }
sphere { 0, 1 pigment { rgb <0.5, 0.2, 0.02> } finish { ambient 1 diffuse 0 } }
