// mistakes in lines 2, 4: `#case` and `#break` without `#switch`
#case (1)
  sphere { 0, 1 }
#break
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
