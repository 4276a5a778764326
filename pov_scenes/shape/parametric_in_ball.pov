// Within a ball a parametric surface hides its own shadows, as in POV-Ray.
// size: 96x72
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -4> look_at 0 angle 45 }
light_source { <1, 5, -2> rgb 1 }
background { rgb <0.1, 0.2, 0.3> }
parametric {
  function { v } function { sin(u)*0.8 } function { cos(u)*0.8 }
  <-2.2, -1>, <2.2, 1>
  contained_by { sphere { 0, 1.6 } }
  max_gradient 1 accuracy 0.002
  pigment { rgb <0.9, 0.7, 0.4> }
}
