// mistake in line 2: a pigment in a material
sphere { 0, 1 material { pigment { rgbt 1 } interior { ior 1.5 } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
