// Transformations in a material move the media of its interior as they move its textures, as far as both stand before them.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -8> look_at 0 angle 42 }
#declare Grains = density { granite density_map { [0.4 rgb 0] [0.6 rgb 1] } scale 0.4 }
#declare Cloud = interior { media { emission 0.6 density { Grains } } media { absorption 0.5 density { bozo scale 0.2 } } }
#declare Clear = texture { pigment { checker rgbt <1, 1, 1, 0.9> rgbt <1, 0.5, 0.5, 0.9> scale 0.3 } }
#declare Filled = material { texture { Clear } interior { Cloud } }
#declare Ball = sphere { 0, 0.8 hollow }
background { rgb <0.3, 0.4, 0.6> }
object { Ball material { texture { Clear } interior { Cloud } scale 3 rotate 20*z } translate <-1.8, 0.9, 0> }
object { Ball material { texture { Clear } scale 3 interior { Cloud } } translate <0, 0.9, 0> }
object { Ball material { Filled scale <0.5, 2, 1> } translate <1.8, 0.9, 0> }
object { Ball scale <1, 0.7, 1> material { Filled scale 3 } translate <-1.8, -0.9, 0> }
object { Ball material { Filled translate 0.4*x } scale <1, 0.7, 1> translate <0, -0.9, 0> }
object { Ball material { Filled } translate <1.8, -0.9, 0> }
