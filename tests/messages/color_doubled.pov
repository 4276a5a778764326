// doubt in line 2: `color` stands twice; POV-Ray refuses it
sphere { 0, 1 pigment { color color rgb 1 } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
