// mistake in line 3: the name of a density file without quotes
sphere { 0, 1 hollow pigment { rgbt 1 } interior { media { emission 1
  density { density_file df3 cloud.df3 interpolate 1 } } } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
