// Media of method 3 with an odd number of samples: half of them, rounded up, are the steps.
#version 3.8;
global_settings { assumed_gamma 1 }
camera { orthographic location <2, 1.5, -5> direction z right 4*x up 3*y }
background { rgb 1 }
#macro Slab(Row, Samples, Level)
  box {
    <0, Row, 0>, <4, Row + 0.9, 4> hollow pigment { rgbt 1 } finish { ambient 0 diffuse 0 }
    interior {
      media {
        absorption <0.5, 0.3, 0.2> method 3 intervals 1 samples Samples aa_level Level
        density { function { select(z - x, 0, 1) } color_map { [0 rgb 0] [1 rgb 1] } }
      }
    }
  }
#end
Slab(0, 3, 1)
Slab(1, 7, 1)
Slab(2, 5, 3)
