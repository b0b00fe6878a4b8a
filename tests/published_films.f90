!> Tables of bearings of finite length that a numerical film must meet.
!>
!> Rotation: bearing at rest, journal at omega, centre steady: So = F psi^2/(L D mu omega), beta between load and line of centres,
!> side flow Q over R^3 psi omega, psi = c/R; p >= 0, and p = 0 along the line of the widest gap. Squeeze: the centre moves along
!> the line of centres and nothing turns, So = F psi^2/(L D mu |eps'|), eps below zero: the journal parts. What is not printed
!> is zero. Source: H.-J. Butenschoen, Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter instationaerer Belastung,
!> dissertation, Karlsruhe (1976). Two-groove bearing: grooves of 20 degrees at both sides, load through the middle of the lower
!> pad, x along it; S = mu N L D (R/c)^2/W, K = k c/W, B = b c omega/W. Source: J. W. Lund and K. K. Thomsen, A calculation method
!> and data for the dynamic coefficients of oil-lubricated journal bearings, ASME (1978).
module published_films
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: grooved, rotation_angle, rotation_eps, rotation_flow, rotation_load, rotation_ratio
   public :: squeeze_eps, squeeze_load, squeeze_ratio

   real(wp), parameter :: rotation_ratio(4) = [ &
         1.0_wp, 0.5_wp, 0.25_wp, 0.125_wp]
      !! (4) L/D [1]
   real(wp), parameter :: rotation_eps(16) = [ &
         0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.9_wp, 0.95_wp, 0.96_wp, 0.97_wp, 0.98_wp, 0.99_wp, &
         0.995_wp, 0.999_wp]
      !! (16) eccentricity ratio [1]
   real(wp), parameter :: rotation_load(16, 4) = reshape([ &
         0.1196_wp, 0.2518_wp, 0.4091_wp, 0.6108_wp, 0.8903_wp, 1.3146_wp, 2.0432_wp, 3.5663_wp, 8.4352_wp, 18.7895_wp, &
         24.1172_wp, 33.1297_wp, 51.4774_wp, 107.7868_wp, 223.885_wp, 1174.54_wp, 0.0368_wp, 0.0783_wp, 0.1304_wp, 0.2026_wp, &
         0.3124_wp, 0.4982_wp, 0.8595_wp, 1.7339_wp, 5.0881_wp, 13.3083_wp, 17.7934_wp, 25.592_wp, 41.923_wp, 93.7881_wp, &
         203.245_wp, 1124.62_wp, 0.0098_wp, 0.021_wp, 0.0354_wp, 0.056_wp, 0.0888_wp, 0.1476_wp, 0.2708_wp, 0.6043_wp, &
         2.1595_wp, 6.9248_wp, 9.8517_wp, 15.2697_wp, 27.504_wp, 70.0359_wp, 166.154_wp, 1032.87_wp, 0.0025_wp, 0.0054_wp, &
         0.0091_wp, 0.0144_wp, 0.0231_wp, 0.039_wp, 0.0732_wp, 0.1706_wp, 0.6776_wp, 2.5202_wp, 3.7907_wp, 6.3397_wp, &
         12.7695_wp, 39.2568_wp, 109.609_wp, 864.74_wp], [16, 4])
      !! (16, 4) So [1]
   real(wp), parameter :: rotation_angle(16, 4) = reshape([ &
         79.41_wp, 73.858_wp, 68.264_wp, 62.571_wp, 56.705_wp, 50.536_wp, 43.859_wp, 36.235_wp, 26.482_wp, 19.45_wp, &
         17.609_wp, 15.484_wp, 12.903_wp, 9.416_wp, 6.829_wp, 3.196_wp, 81.767_wp, 75.142_wp, 68.493_wp, 61.778_wp, 54.993_wp, &
         48.049_wp, 40.803_wp, 32.938_wp, 23.566_wp, 17.265_wp, 15.66_wp, 13.818_wp, 11.598_wp, 8.587_wp, 6.325_wp, 3.048_wp, &
         82.481_wp, 75.287_wp, 68.204_wp, 61.208_wp, 54.069_wp, 46.825_wp, 39.326_wp, 31.249_wp, 21.79_wp, 15.632_wp, &
         14.109_wp, 12.299_wp, 10.375_wp, 7.703_wp, 5.733_wp, 2.848_wp, 82.653_wp, 75.422_wp, 68.211_wp, 61.007_wp, 53.784_wp, &
         46.449_wp, 38.865_wp, 30.692_wp, 21.089_wp, 14.832_wp, 13.262_wp, 11.57_wp, 9.558_wp, 6.975_wp, 5.151_wp, &
         2.599_wp], [16, 4])
      !! (16, 4) beta [deg]
   real(wp), parameter :: rotation_flow(16, 4) = reshape([ &
         0.1603_wp, 0.3196_wp, 0.4765_wp, 0.6318_wp, 0.7852_wp, 0.9374_wp, 1.0888_wp, 1.2392_wp, 1.3898_wp, 1.4655_wp, &
         1.4808_wp, 1.4968_wp, 1.5124_wp, 1.5277_wp, 1.5354_wp, 1.5409_wp, 0.0939_wp, 0.1878_wp, 0.2816_wp, 0.3755_wp, &
         0.4694_wp, 0.5634_wp, 0.6578_wp, 0.7529_wp, 0.8453_wp, 0.8984_wp, 0.9084_wp, 0.9185_wp, 0.9287_wp, 0.9351_wp, &
         0.9441_wp, 0.9482_wp, 0.0492_wp, 0.0984_wp, 0.1476_wp, 0.1968_wp, 0.246_wp, 0.2953_wp, 0.3446_wp, 0.394_wp, &
         0.4436_wp, 0.4687_wp, 0.4737_wp, 0.4788_wp, 0.484_wp, 0.4892_wp, 0.4918_wp, 0.494_wp, 0.0249_wp, 0.0498_wp, &
         0.0747_wp, 0.0996_wp, 0.1245_wp, 0.1494_wp, 0.1743_wp, 0.1992_wp, 0.2241_wp, 0.2366_wp, 0.2391_wp, 0.2417_wp, &
         0.2442_wp, 0.2467_wp, 0.248_wp, 0.2491_wp], [16, 4])
      !! (16, 4) Q [1]
   real(wp), parameter :: squeeze_ratio(3) = [1.0_wp, 1.0_wp/3.0_wp, 0.125_wp]
      !! (3) L/D [1]
   real(wp), parameter :: squeeze_eps(29) = [ &
         -0.99_wp, -0.98_wp, -0.97_wp, -0.96_wp, -0.95_wp, -0.9_wp, -0.8_wp, -0.7_wp, -0.6_wp, -0.5_wp, -0.4_wp, -0.3_wp, &
         -0.2_wp, -0.1_wp, 0.0_wp, 0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.9_wp, 0.95_wp, 0.96_wp, &
         0.97_wp, 0.98_wp, 0.99_wp]
      !! (29) eccentricity ratio, below zero: parting [1]
   real(wp), parameter :: squeeze_load(29, 3) = reshape([ &
         0.4925_wp, 0.4986_wp, 0.5049_wp, 0.5113_wp, 0.5177_wp, 0.5518_wp, 0.6293_wp, 0.7242_wp, 0.8342_wp, 0.971_wp, &
         1.1391_wp, 1.3494_wp, 1.6134_wp, 1.9579_wp, 2.4076_wp, 3.0122_wp, 3.8485_wp, 5.0479_wp, 6.8503_wp, 9.7319_wp, &
         14.769_wp, 24.842_wp, 50.349_wp, 160.25_wp, 490.18_wp, 699.59_wp, 1098.6_wp, 2073.5_wp, 6057.9_wp, 0.0588_wp, &
         0.0596_wp, 0.0604_wp, 0.0612_wp, 0.062_wp, 0.0663_wp, 0.0761_wp, 0.0881_wp, 0.1028_wp, 0.1211_wp, 0.1443_wp, &
         0.1739_wp, 0.2127_wp, 0.2645_wp, 0.3355_wp, 0.4357_wp, 0.5826_wp, 0.8081_wp, 1.1756_wp, 1.8236_wp, 3.1002_wp, &
         6.0733_wp, 15.282_wp, 68.484_wp, 275.76_wp, 422.2_wp, 720.35_wp, 1490.8_wp, 4884.9_wp, 0.0084_wp, 0.0085_wp, &
         0.0086_wp, 0.0087_wp, 0.0_wp, 0.0095_wp, 0.0109_wp, 0.0126_wp, 0.0147_wp, 0.0174_wp, 0.0207_wp, 0.025_wp, 0.0307_wp, &
         0.0383_wp, 0.0488_wp, 0.0637_wp, 0.0859_wp, 0.1203_wp, 0.1774_wp, 0.2803_wp, 0.4899_wp, 1.0027_wp, 2.7312_wp, &
         14.77_wp, 76.315_wp, 127.78_wp, 245.48_wp, 600.66_wp, 2560.1_wp], [29, 3])
      !! (29, 3) So [1]
   real(wp), parameter :: grooved(10, 5) = reshape([ &
         1.656_wp, 0.244_wp, 65.85_wp, 1.69_wp, 5.06_wp, -2.2_wp, 1.95_wp, 9.93_wp, 2.15_wp, 4.8_wp, 0.917_wp, 0.372_wp, &
         57.45_wp, 2.12_wp, 4.01_wp, -1.3_wp, 1.85_wp, 7.7_wp, 2.06_wp, 3.23_wp, 0.58_wp, 0.477_wp, 51.01_wp, 2.67_wp, 3.7_wp, &
         -0.78_wp, 1.75_wp, 6.96_wp, 1.94_wp, 2.4_wp, 0.379_wp, 0.57_wp, 45.43_wp, 3.33_wp, 3.64_wp, -0.43_wp, 1.68_wp, &
         6.76_wp, 1.87_wp, 1.89_wp, 0.244_wp, 0.655_wp, 40.25_wp, 4.21_wp, 3.74_wp, -0.13_wp, 1.64_wp, 6.87_wp, 1.82_wp, &
         1.54_wp], [10, 5])
      !! (10, 5) S [1], eps [1], attitude [deg], Kxx, Kxy, Kyx, Kyy, Bxx, Bxy = Byx, Byy [1] of L/D = 0.5

end module published_films
